from graphs.least_squares._nearest_solution import (
    NearestSolution as NearestSolution,
    nearest_solution as nearest_solution,
)
from graphs.least_squares.batched import BatchedSearch as BatchedSearch, BatchedSystem as BatchedSystem
from graphs.least_squares.gauss_newton import GaussNewton as GaussNewton, Root as Root, find_root as find_root
from graphs.least_squares.levenberg_marquardt import (
    LeastSquaresIterate as LeastSquaresIterate,
    LevenbergMarquardt as LevenbergMarquardt,
    Minimum as Minimum,
    System as System,
    Trial as Trial,
    least_squares as least_squares,
    minimise as minimise,
)
from graphs.least_squares.steps import (
    bounded_step as bounded_step,
    damped_step as damped_step,
    minimum_norm_step as minimum_norm_step,
    normal_step as normal_step,
)
from graphs.least_squares.stop_reason import StopReason as StopReason
