"""Solids as files, for printers and viewers: STL, 3MF, OBJ, glTF. Each panel is a closed mesh, in millimetres.

These are written only: a mesh does not say which edges are hinges.
"""
