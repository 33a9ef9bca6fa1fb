from graphs.least_squares._nearest_solution import nearest_solution as nearest_solution
from graphs.least_squares.levenberg_marquardt import least_squares as least_squares
from graphs.least_squares.steps import (
    bounded_step as bounded_step,
    damped_step as damped_step,
    minimum_norm_step as minimum_norm_step,
    normal_step as normal_step,
)
