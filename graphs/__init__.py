"""What a mechanism is: graphs, models, mobility, conversions and files.

Import from the modules by name, for example ``from graphs.mechanism.sc import SCGraph``.
Nothing is imported here, so that the command line starts quickly.
"""
