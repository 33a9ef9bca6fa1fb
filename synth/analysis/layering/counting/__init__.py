"""Numbers of solutions of conditions on layers: a counter in Python (`problem`), the same in C (`kernel.c`), a job.

`settling` says what follows from orders that are known, and asks the library of C where there is one.
"""
