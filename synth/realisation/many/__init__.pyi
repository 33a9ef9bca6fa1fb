from synth.realisation.many.folder import FolderOfThings as FolderOfThings
from synth.realisation.many.job import RealisationJob as RealisationJob, summary_of as summary_of
