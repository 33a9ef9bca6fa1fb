from synth.synthesis.candidates.job import (
    CandidateCountJob as CandidateCountJob,
    CandidateJob as CandidateJob,
    Filter as Filter,
)
from synth.synthesis.candidates.listing import (
    conical_candidates as conical_candidates,
    count_conical_candidates as count_conical_candidates,
)
from synth.synthesis.candidates.pictures import PictureSink as PictureSink, picture_of_row as picture_of_row
