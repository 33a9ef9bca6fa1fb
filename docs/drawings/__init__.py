"""Drawings of the theory pages, made of the project's own pictures: ``make pictures`` writes all of them.

`drawings.pages` says which page has which; a module draws those of one part of the theory, and `drawings.together`
puts pictures beside each other; `drawings.pieces` has arrows, words and what makes pictures smaller.
"""
