"""Where machine code is kept between runs, what it is made of, and a word to the user when it has to be made.

`enumerate.kernel.compiled` decorates what is compiled; a numba function asks here first. Without numba are
``notice`` and ``folders``, which the command line uses.
"""
