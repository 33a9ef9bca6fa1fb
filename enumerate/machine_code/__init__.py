"""Kernels, interpreted or as machine code; where that is kept between runs, and a word when it has to be made.

``kernels`` decorates what is compiled, and ``weights`` says when that pays; a numba function asks ``cache`` first.
All but that load without numba.
"""
