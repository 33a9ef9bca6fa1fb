"""BibTeX of the sources on which the answers of commands rest: ``synth COMMAND --cite``.

The sources of a command are those that the theory pages of its functions name (docs/theory). Fields that could not
be checked against the source are left out. To cite synthedra itself: ``CITATION.cff``.
"""

from collections.abc import Sequence

from graphs.errors import InvariantError

ENTRIES = {
    "wiener2016": ("mastersthesis", {"author": "Wiener", "title": "Spherical system linkages", "year": "2016"}),
    "wampler2007": ("inproceedings", {
        "author": "Wampler, Charles and Larson, Benjamin and Erdman, Arthur",
        "title": "A New Mobility Formula for Spatial Mechanisms", "year": "2007",
    }),
    "hyatt2020": ("article", {
        "author": "Hyatt, Lance P. and Magleby, Spencer P. and Howell, Larry L.",
        "title": "Developable mechanisms on right conical surfaces", "journal": "Mechanism and Machine Theory",
        "volume": "149", "pages": "103813", "year": "2020",
    }),
    "hyatt2021": ("misc", {
        "author": "Hyatt, Lance P. and others", "title": "Mapping of mechanisms to developable surfaces",
        "note": "Title by its subject", "year": "2021",
    }),
    "tipparthi2011": ("misc", {
        "author": "Tipparthi and Larochelle", "title": "Order of orientations of spherical four-bars: the hoop method",
        "note": "Title by its subject", "year": "2011",
    }),
    "sommese2005": ("book", {
        "author": "Sommese, Andrew J. and Wampler, Charles W.",
        "title": "The Numerical Solution of Systems of Polynomials Arising in Engineering and Science",
        "publisher": "World Scientific", "year": "2005",
    }),
    "sommese2002": ("article", {
        "author": "Sommese, Andrew J. and Verschelde, Jan and Wampler, Charles W.",
        "title": "Symmetric functions applied to decomposing solution sets of polynomial systems",
        "journal": "SIAM Journal on Numerical Analysis", "volume": "40", "year": "2002",
    }),
    "capco2018": ("article", {
        "author": "Capco, Jose and Gallet, Matteo and Grasegger, Georg and Koutschan, Christoph and Lubbes, Niels "
        "and Schicho, Josef",
        "title": "The number of realizations of a Laman graph",
        "journal": "SIAM Journal on Applied Algebra and Geometry", "volume": "2", "year": "2018",
    }),
    "gallet2020": ("article", {
        "author": "Gallet, Matteo and Grasegger, Georg and Schicho, Josef",
        "title": "Counting realizations of Laman graphs on the sphere",
        "journal": "Electronic Journal of Combinatorics", "volume": "27", "year": "2020",
    }),
    "mccarthy": ("book", {"author": "McCarthy, J. Michael", "title": "Geometric Design of Linkages",
                          "series": "Interdisciplinary Applied Mathematics", "volume": "11",
                          "publisher": "Springer"}),
    "yan1991": ("misc", {"author": "Yan and Hwang", "year": "1991",
                         "note": "Numbers of kinematic chains; cited in docs/theory/chains.md"}),
    "mckay1998": ("article", {
        "author": "McKay, Brendan D.", "title": "Isomorph-free exhaustive generation",
        "journal": "Journal of Algorithms", "volume": "26", "number": "2", "pages": "306--324",
        "year": "1998", "doi": "10.1006/jagm.1997.0898",
    }),
    "junttila2007": ("inproceedings", {
        "author": "Junttila, Tommi and Kaski, Petteri",
        "title": "Engineering an Efficient Canonical Labeling Tool for Large and Sparse Graphs",
        "booktitle": "Proceedings of the Ninth Workshop on Algorithm Engineering and Experiments (ALENEX)",
        "pages": "135--149", "publisher": "SIAM", "year": "2007", "doi": "10.1137/1.9781611972870.13",
    }),
    "bern1996": ("inproceedings", {
        "author": "Bern, Marshall and Hayes, Barry", "title": "The complexity of flat origami", "booktitle": "SODA",
        "year": "1996",
    }),
    "akitaya2015": ("inproceedings", {
        "author": "Akitaya, H. A. and Cheung, K. C. and Demaine, E. D. and Horiyama, T. and Hull, T. C. and Ku, J. S. "
        "and Tachi, T. and Uehara, R.",
        "title": "Box pleating is hard", "year": "2015",
    }),
    "ku": ("misc", {"author": "Ku, J. S.", "title": "Flat-Folder"}),
    "eppstein2024": ("misc", {
        "author": "Eppstein, D.", "title": "Computational complexities of folding", "eprint": "2410.07666",
        "archiveprefix": "arXiv", "year": "2024",
    }),
    "bayardo2000": ("inproceedings", {
        "author": "Bayardo Jr., R. J. and Pehoushek, J. D.", "title": "Counting models using connected components",
        "year": "2000",
    }),
    "tutte1963": ("article", {
        "author": "Tutte, W. T.", "title": "How to draw a graph",
        "journal": "Proceedings of the London Mathematical Society", "volume": "13", "pages": "743--767",
        "year": "1963",
    }),
}  # fmt: skip
"""Key of a source to its kind and its fields."""

_MOBILITY = ("wiener2016", "wampler2007")
_CONES = ("hyatt2020", "hyatt2021")
_CHAINS = ("yan1991", "mckay1998", "junttila2007")
_GUIDANCE = ("tipparthi2011", "mccarthy")
_LAYERS = ("bern1996", "akitaya2015", "ku", "bayardo2000", "eppstein2024")

CITED: dict[str, tuple[str, ...]] = {
    "look": (*_MOBILITY, *_LAYERS),
    "mobility": (*_MOBILITY, *_LAYERS),
    "layers": _LAYERS,
    "positions": ("sommese2005", "sommese2002", "capco2018", "gallet2020", "wampler2007"),
    "explain": _MOBILITY,
    "states": ("wiener2016",),
    "limits": ("wiener2016",),
    "draw": ("wiener2016", "tutte1963"),
    "template": _CONES,
    "reduce": ("wiener2016",),
    "edit": ("wiener2016",),
    "convert": ("wiener2016", "wampler2007"),
    "reconstruct": _MOBILITY,
    "id": ("junttila2007",),
    "enumerate chains": _CHAINS,
    "enumerate sc": ("wiener2016", *_CHAINS[1:]),
    "enumerate scd": ("wiener2016", *_CHAINS[1:]),
    "enumerate strings": ("wiener2016",),
    "enumerate addenda": ("wiener2016",),
    "enumerate conical": _CONES,
    "atlas": ("wiener2016", *_CHAINS),
    "cone": (*_CONES, "mccarthy"),
    "cylinder": _CONES,
    "order": ("tipparthi2011",),
    "dyads": _GUIDANCE,
    "fourbar": _GUIDANCE,
}
"""Command, with that of its group, to the keys of its sources; a group stands for all its commands."""


def sources_of(command: str) -> tuple[str, ...]:
    """Return the keys of the sources of a command, such as ``enumerate chains``; none if it rests on no paper.

    >>> sources_of("cone map")
    ('hyatt2020', 'hyatt2021', 'mccarthy')
    """
    return CITED.get(command, CITED.get(command.partition(" ")[0], ()))


def bibtex(keys: Sequence[str]) -> str:
    """Return the entries of some sources as BibTeX.

    Parameters
    ----------
    keys : sequence of str
        Keys of `ENTRIES`.

    Returns
    -------
    str

    Raises
    ------
    InvariantError
        If there is no such key.

    Examples
    --------
    >>> print(bibtex(["wiener2016"]))
    @mastersthesis{wiener2016,
      author = {Wiener},
      title = {Spherical system linkages},
      year = {2016},
    }
    """
    for key in keys:
        if key not in ENTRIES:
            raise InvariantError("source", f"{key!r} is no source", f"one of {', '.join(ENTRIES)}")
    return "\n\n".join(_entry(key, *ENTRIES[key]) for key in keys)


def _entry(key: str, kind: str, fields: dict[str, str]) -> str:
    lines = [f"  {name} = {{{value}}}," for name, value in fields.items()]
    return "\n".join([f"@{kind}{{{key},", *lines, "}"])
