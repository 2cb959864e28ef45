"""The one table of references, printed for readers and as BibTeX entries.

A title or a DOI that could not be confirmed is left out.
"""

from __future__ import annotations

from dataclasses import dataclass

#: Characters that are commands of LaTeX.
_ESCAPED = str.maketrans({"&": r"\&", "%": r"\%", "#": r"\#", "_": r"\_", "$": r"\$"})


@dataclass(frozen=True)
class Reference:
    """A paper, a book or another source."""

    key: str  # of the BibTeX entry
    authors: tuple[str, ...] = ()  # initials before the family name; empty if unknown
    year: int | None = None
    title: str = ""  # empty if unknown
    journal: str = ""  # of a paper
    volume: str = ""
    pages: str = ""  # or the first page, or the number of the paper
    publisher: str = ""  # of a book
    doi: str = ""  # empty if there is none, or none that is certain
    note: str = ""  # further text, or all that is known of the source

    def __str__(self) -> str:
        title = f"“{self.title}”" if self.title and not self.publisher else self.title
        journal = " ".join(part for part in (self.journal, self.volume) if part)
        place = journal or self.publisher
        year = f"({self.year})" if self.year else ""
        pages = self.pages.replace("--", "–")
        where = " ".join(part for part in (place, year, pages) if part)
        doi = f"doi:{self.doi}" if self.doi else ""
        return ", ".join(part for part in (", ".join(self.authors), title, where, doi, self.note) if part)

    def bibtex(self) -> str:
        """Return the BibTeX entry, in UTF-8."""
        kind = "article" if self.journal else "book" if self.publisher else "misc"
        fields = {
            "author": " and ".join(author if "." in author else f"{{{author}}}" for author in self.authors),
            "title": f"{{{self.title}}}" if self.title else "",
            "journal": self.journal,
            "volume": self.volume,
            "pages": self.pages,
            "publisher": self.publisher,
            "year": str(self.year or ""),
            "note": self.note,
        }
        lines = [f"  {name} = {{{text.translate(_ESCAPED)}}}," for name, text in fields.items() if text]
        if self.doi:
            lines.append(f"  doi = {{{self.doi}}},")
        return "\n".join([f"@{kind}{{{self.key},", *lines, "}"])


_TABLE = (
    Reference(
        "putignano2016",
        ("C. Putignano", "T. Reddyhoff", "D. Dini"),
        2016,
        "The influence of temperature on viscoelastic friction properties",
        "Tribol. Int.",
        "100",
        "338--343",
        note="the paper that viscofric implements",
    ),
    Reference(
        "akaike1974",
        ("H. Akaike",),
        1974,
        "A new look at the statistical model identification",
        "IEEE Trans. Autom. Control",
        "19",
        "716--723",
        doi="10.1109/TAC.1974.1100705",
    ),
    Reference(
        "anderson1965",
        ("D. G. Anderson",),
        1965,
        "Iterative procedures for nonlinear integral equations",
        "J. ACM",
        "12",
        "547--560",
        doi="10.1145/321296.321305",
    ),
    Reference(
        "bardsley2014",
        ("J. M. Bardsley", "A. Solonen", "H. Haario", "M. Laine"),
        2014,
        "Randomize-then-optimize: a method for sampling from posterior distributions in nonlinear inverse problems",
        "SIAM J. Sci. Comput.",
        "36",
        "A1895--A1910",
        doi="10.1137/140964023",
    ),
    Reference(
        "carbone2008",
        ("G. Carbone", "L. Mangialardi"),
        2008,
        "Analysis of the adhesive contact of confined layers by using a Green's function approach",
        "J. Mech. Phys. Solids",
        "56",
        "684",
        doi="10.1016/j.jmps.2007.05.009",
    ),
    Reference(
        "carbone2013",
        ("G. Carbone", "C. Putignano"),
        2013,
        "A novel methodology to predict sliding and rolling friction of viscoelastic materials: theory and experiments",
        "J. Mech. Phys. Solids",
        "61",
        "1822--1834",
    ),
    Reference(
        "chen2012",
        ("Y. Chen", "D. S. Oliver"),
        2012,
        "Ensemble randomized maximum likelihood method as an iterative ensemble smoother",
        "Math. Geosci.",
        "44",
        "1--26",
    ),
    Reference(
        "cleveland1979",
        ("W. S. Cleveland",),
        1979,
        "Robust locally weighted regression and smoothing scatterplots",
        "J. Am. Stat. Assoc.",
        "74",
        "829--836",
        doi="10.1080/01621459.1979.10481038",
    ),
    Reference(
        "efron1993",
        ("B. Efron", "R. J. Tibshirani"),
        1993,
        "An Introduction to the Bootstrap",
        publisher="Chapman & Hall",
        doi="10.1007/978-1-4899-4541-9",
    ),
    Reference(
        "eisenstat1983",
        ("S. C. Eisenstat", "H. C. Elman", "M. H. Schultz"),
        1983,
        "Variational iterative methods for nonsymmetric systems of linear equations",
        "SIAM J. Numer. Anal.",
        "20",
        "345--357",
        doi="10.1137/0720023",
    ),
    Reference(
        "eyring1936",
        ("H. Eyring",),
        1936,
        "Viscosity, plasticity, and diffusion as examples of absolute reaction rates",
        "J. Chem. Phys.",
        "4",
        "283--291",
        doi="10.1063/1.1749836",
    ),
    Reference(
        "fritsch1984",
        ("F. N. Fritsch", "J. Butland"),
        1984,
        "A method for constructing local monotone piecewise cubic interpolants",
        "SIAM J. Sci. Stat. Comput.",
        "5",
        "300--304",
        doi="10.1137/0905021",
    ),
    Reference(
        "fulcher1925",
        ("G. S. Fulcher",),
        1925,
        "Analysis of recent measurements of the viscosity of glasses",
        "J. Am. Ceram. Soc.",
        "8",
        "339--355",
        doi="10.1111/j.1151-2916.1925.tb16731.x",
    ),
    Reference(
        "giles2000",
        ("M. B. Giles", "N. A. Pierce"),
        2000,
        "An introduction to the adjoint approach to design",
        "Flow Turbul. Combust.",
        "65",
        "393--415",
        doi="10.1023/A:1011430410075",
    ),
    Reference(
        "golub1973",
        ("G. H. Golub", "V. Pereyra"),
        1973,
        "The differentiation of pseudo-inverses and nonlinear least squares problems whose variables separate",
        "SIAM J. Numer. Anal.",
        "10",
        "413--432",
        doi="10.1137/0710036",
    ),
    Reference(
        "hansen1993",
        ("P. C. Hansen", "D. P. O'Leary"),
        1993,
        "The use of the L-curve in the regularization of discrete ill-posed problems",
        "SIAM J. Sci. Comput.",
        "14",
        "1487--1503",
        doi="10.1137/0914086",
    ),
    Reference(
        "hertz1882",
        ("H. Hertz",),
        1882,
        "Ueber die Berührung fester elastischer Körper",
        "J. reine angew. Math.",
        "92",
        "156--171",
        doi="10.1515/crll.1882.92.156",
    ),
    Reference(
        "hunter1961",
        ("S. C. Hunter",),
        1961,
        "The rolling contact of a rigid cylinder with a viscoelastic half space",
        "J. Appl. Mech.",
        "28",
        "611",
    ),
    Reference(
        "jacobs2017",
        ("T. D. B. Jacobs", "T. Junge", "L. Pastewka"),
        2017,
        "Quantitative characterization of surface topography using spectral analysis",
        "Surf. Topogr.: Metrol. Prop.",
        "5",
        "013001",
        doi="10.1088/2051-672X/aa51f8",
    ),
    Reference(
        "johnson1985",
        ("K. L. Johnson",),
        1985,
        "Contact Mechanics",
        publisher="Cambridge University Press",
        doi="10.1017/CBO9781139171731",
    ),
    Reference(
        "kraus1984",
        ("G. Kraus",),
        1984,
        "Mechanical losses in carbon-black-filled rubbers",
        "J. Appl. Polym. Sci. Appl. Polym. Symp.",
        "39",
        "75--92",
    ),
    Reference(
        "lawson1974",
        ("C. L. Lawson", "R. J. Hanson"),
        1974,
        "Solving Least Squares Problems",
        publisher="Prentice-Hall",
        doi="10.1137/1.9781611971217",
        note="reprinted by SIAM (1995)",
    ),
    Reference(
        "lee1960",
        ("E. H. Lee", "J. R. M. Radok"),
        1960,
        "The contact problem for viscoelastic bodies",
        "J. Appl. Mech.",
        "27",
        "438--444",
    ),
    Reference(
        "lions1979",
        ("P. L. Lions", "B. Mercier"),
        1979,
        "Splitting algorithms for the sum of two nonlinear operators",
        "SIAM J. Numer. Anal.",
        "16",
        "964--979",
        doi="10.1137/0716071",
    ),
    Reference(
        "lorenz2015",
        ("B. Lorenz", "Y. R. Oh", "S. K. Nam", "S. H. Jeon", "B. N. J. Persson"),
        2015,
        "Rubber friction on road surfaces: Experiment and theory for low sliding speeds",
        "J. Chem. Phys.",
        "142",
        "194701",
    ),
    Reference(
        "love1929",
        ("A. E. H. Love",),
        1929,
        "The stress produced in a semi-infinite solid by pressure on part of the boundary",
        "Phil. Trans. R. Soc. A",
        "228",
        "377--420",
        doi="10.1098/rsta.1929.0009",
    ),
    Reference(
        "park1999",
        ("S. W. Park", "R. A. Schapery"),
        1999,
        "Methods of interconversion between linear viscoelastic material functions. Part I: "
        "A numerical method based on Prony series",
        "Int. J. Solids Struct.",
        "36",
        "1653--1675",
        doi="10.1016/S0020-7683(98)00055-9",
    ),
    Reference(
        "persson2001",
        ("B. N. J. Persson",),
        2001,
        "Theory of rubber friction and contact mechanics",
        "J. Chem. Phys.",
        "115",
        "3840--3861",
        doi="10.1063/1.1388626",
    ),
    Reference(
        "persson2005",
        ("B. N. J. Persson", "O. Albohr", "U. Tartaglino", "A. I. Volokitin", "E. Tosatti"),
        2005,
        "On the nature of surface roughness with application to contact mechanics, sealing, rubber friction "
        "and adhesion",
        "J. Phys.: Condens. Matter",
        "17",
        "R1--R62",
        doi="10.1088/0953-8984/17/1/R01",
    ),
    Reference(
        "persson2006",
        ("B. N. J. Persson",),
        2006,
        "Rubber friction: role of the flash temperature",
        "J. Phys.: Condens. Matter",
        "18",
        "7789",
        doi="10.1088/0953-8984/18/32/025",
    ),
    Reference(
        "putignano2015",
        ("C. Putignano", "G. Carbone", "D. Dini"),
        2015,
        "Mechanics of rough contacts in elastic and viscoelastic thin layers",
        "Int. J. Solids Struct.",
        "69--70",
        "507",
        doi="10.1016/j.ijsolstr.2015.04.034",
    ),
    Reference(
        "tammann1926",
        ("G. Tammann", "W. Hesse"),
        1926,
        "Die Abhängigkeit der Viscosität von der Temperatur bei unterkühlten Flüssigkeiten",
        "Z. anorg. allg. Chem.",
        "156",
        "245",
        doi="10.1002/zaac.19261560121",
    ),
    Reference(
        "vangurp1998",
        ("M. van Gurp", "J. Palmen"),
        1998,
        "Time-temperature superposition for polymeric blends",
        "Rheol. Bull.",
        "67",
        "5--8",
    ),
    Reference(
        "vogel1921",
        ("H. Vogel",),
        1921,
        "Das Temperaturabhängigkeitsgesetz der Viskosität von Flüssigkeiten",
        "Physikalische Zeitschrift",
        "22",
        "645--646",
    ),
    Reference(
        "williams1955",
        ("M. L. Williams", "R. F. Landel", "J. D. Ferry"),
        1955,
        "The temperature dependence of relaxation mechanisms in amorphous polymers and other glass-forming liquids",
        "J. Am. Chem. Soc.",
        "77",
        "3701--3707",
        doi="10.1021/ja01619a008",
    ),
    Reference(
        "wood2011",
        ("S. N. Wood",),
        2011,
        "Fast stable restricted maximum likelihood and marginal likelihood estimation of semiparametric generalized "
        "linear models",
        "J. R. Stat. Soc. B",
        "73",
        "3--36",
        doi="10.1111/j.1467-9868.2010.00749.x",
    ),
    Reference(
        "yastrebov2017",
        ("V. A. Yastrebov", "G. Anciaux", "J.-F. Molinari"),
        2017,
        "On the accurate computation of the true contact-area in mechanical contact of random rough surfaces",
        "Tribol. Int.",
        "114",
        "161--171",
        doi="10.1016/j.triboint.2017.04.023",
    ),
)

#: Key -> reference.
REFERENCES = {reference.key: reference for reference in _TABLE}
PAPER = _TABLE[0]
