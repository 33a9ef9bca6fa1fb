from synth.candidates.job import (
    CandidateCountJob as CandidateCountJob,
    CandidateJob as CandidateJob,
    Filter as Filter,
)
from synth.candidates.pictures import PictureSink as PictureSink, picture_of_row as picture_of_row
