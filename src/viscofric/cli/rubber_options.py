"""Options of the material and of its thickness, and how DMA files are read."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from viscofric.cli.commands import Decorator, quantity, together
from viscofric.cli.contact_options import option
from viscofric.cli.errors import print_doubtful_checks, print_notes, typed_as
from viscofric.cli.files import DASH, FILE, Source, plainly
from viscofric.cli.keys import key, table_of
from viscofric.cli.speed_options import chosen_temperatures

if TYPE_CHECKING:
    from xarray import DataTree

    from viscofric.contact.bodies import Layer
    from viscofric.rheology.material import Material
    from viscofric.study.rubber import Rubber


def _piped(ctx: click.Context, param: click.Parameter, value: str | None) -> str | None:
    """Let `-` stand for a rubber's file on standard input."""
    return str(Source().convert(value, param, ctx)) if value == str(DASH) else value


def _headings(ctx: click.Context, param: click.Parameter, value: tuple[str, ...]) -> dict[str, str]:
    """Return the headings of `--column NAME=HEADING` by name."""
    found: dict[str, str] = {}
    for one in value:
        name, equals, said = one.partition("=")
        if not equals or not name.strip() or not said.strip():
            raise click.BadParameter(f"{one!r}: must be NAME=HEADING, such as 'frequency=f in Hz'.")
        found[name.strip()] = said.strip()
    return found


def column_options(example: str, of: str = "", condition: str = "", *, table: str = "material.") -> Decorator:
    """Return a decorator that adds the options of a table whose header is not understood, their names begun by `of`.

    `table`: how the keys of a run file begin that they give.
    """
    heading = f"{condition}heading" if condition else "Heading"
    return together(
        key(
            f"{table}columns",
            f"--{of}column",
            f"{of.replace('-', '_')}columns",
            metavar="NAME=HEADING",
            multiple=True,
            type=str,
            callback=_headings,
            help=f"{heading} of a column whose header is not understood, e.g. "
            f"{example}; repeatable. A unit may follow in brackets; '#2 (Hz)' is the second column.",
        ),
        key(f"{table}sheet", f"--{of}sheet", metavar="NAME", condition=condition),
    )


_WITH_DMA = "With --dma: "
rubber_options = together(
    click.option(
        "--material",
        metavar="NAME|FILE",
        callback=_piped,
        help="Catalogue name, material file (JSON or a card; `-` for standard input), or run file with a [material].",
    ),
    key(
        "material.dma",
        multiple=True,
        type=Source(),
        metavar="FILE",
        help="Alternative: DMA sweeps to fit; repeat for several files of one set.",
    ),
    key(
        "material.reference_temperature",
        "--reference",
        metavar="T",
        help="With --dma: reference temperature, e.g. '30 degC' [default: the middle one of the sweeps].",
    ),
    key("material.deformation", condition=_WITH_DMA),
    key("material.modulus_unit", metavar="UNIT", condition=_WITH_DMA),
    key(
        "material.leave_out_temperatures",
        metavar="T",
        multiple=True,
        help="With --dma: isotherms to leave out, e.g. '60 degC'; repeatable.",
    ),
    column_options("'frequency=f in Hz'", condition=_WITH_DMA),
    key("material.shift", condition=_WITH_DMA),
    key("material.shift_factors", type=FILE, condition=_WITH_DMA),
    click.option("--synthetic", is_flag=True, help="With --dma: the data are synthetic, and no remark (#) says so."),
    click.option(
        "--E0", "rubber_modulus", metavar="E", help="Alternative: standard linear solid; relaxed modulus, e.g. '1 MPa'."
    ),
    click.option("--E-inf", "glass_modulus", metavar="E", help="Glassy modulus, e.g. '10 MPa'."),
    quantity("--tau", "TIME", "Retardation time, e.g. '1 ms'."),
    key("material.poisson_ratio", metavar="ν", type=float, help="Poisson's ratio with --E0 or --dma [default: 0.5]."),
    heading="Material",
)
layer_options = together(
    quantity("--layer", "H", "Thickness of a layer on a rigid base [default: half-space]."),
    click.option("--sliding-base", is_flag=True, help="The layer slides on its base instead of being bonded."),
    heading="Material",
)


#: What DMA files may not say themselves.
_OF_FILES = ("deformation", "modulus_unit", "leave_out_temperatures", "columns", "sheet", "shift", "shift_factors")
_SINGLE = ("rubber_modulus", "glass_modulus", "tau")


class NamedRubber(NamedTuple):
    """A rubber, what it is called, whether it is made up, and what it was made of, where that is known."""

    material: Material
    name: str
    synthetic: bool
    made: Rubber | None = None

    def record(self, temperature: float | None) -> dict[str, Any]:
        """Return it in plain types, with its modes at a temperature (K)."""
        spectrum = self.material.modes_at(temperature)
        return {
            "name": self.name,
            "synthetic": self.synthetic,
            "poisson_ratio": self.material.poisson_ratio,
            "modes": len(spectrum),
            "E0": spectrum.E0,
            "E_inf": spectrum.E_inf,
            "C": [float(one) for one in spectrum.C],
            "tau": [float(one) for one in spectrum.tau],
        }


def chosen_rubber(parameters: dict[str, Any]) -> NamedRubber:
    """Return the rubber that the options name."""
    single = [name for name in _SINGLE if parameters[name] is not None]
    given = [name for name in ("material", "dma") if parameters[name]] + single[:1]
    if len(given) > 1:
        raise click.UsageError(
            f"{option(given[0])} and {option(given[1])} are both given; the rubber comes from one of them."
        )
    if given == ["material"] and parameters["poisson_ratio"] is not None:
        raise click.UsageError("--material and --poisson-ratio are both given; the rubber comes from one of them.")
    for name in ("reference", "synthetic", *_OF_FILES):
        if parameters[name] and given != ["dma"]:
            raise click.UsageError(f"{option(name)} is for --dma only.")
    if given == ["material"]:
        return _named(str(parameters["material"]))
    if given == ["dma"]:
        return _of_sweeps(parameters)
    if single and len(single) < len(_SINGLE):
        missing = " and ".join(option(name) for name in _SINGLE if name not in single)
        raise click.UsageError(f"{option(single[0])} needs {missing} too: the three are a standard linear solid.")
    if not single:
        raise click.UsageError("no material is given; give --material, --dma, or --E0, --E-inf and --tau.")
    from viscofric.rheology.material import Material

    ratio = 0.5 if parameters["poisson_ratio"] is None else parameters["poisson_ratio"]
    material = Material.standard_linear_solid(
        parameters["rubber_modulus"], parameters["glass_modulus"], parameters["tau"], ratio
    )
    return NamedRubber(material, material.name, False)


def _of_sweeps(parameters: dict[str, Any]) -> NamedRubber:
    from viscofric.study.make_rubber import make_rubber
    from viscofric.units import positive

    temperatures = chosen_temperatures({"temperatures": (), **parameters})
    if parameters.get("temperature") is not None:
        temperatures.append(positive(parameters["temperature"], "K", "--temperature"))
    made = make_rubber(table_of("material", parameters), temperatures=temperatures)
    print_notes(made.notes)
    print_doubtful_checks(tree_of(made), but=_IN_RESULTS)
    first, *more = parameters["dma"]
    name = f"the rubber of {plainly(str(first.name))}" + (f" and {len(more)} more" if more else "")
    return NamedRubber(made.material, name, parameters["synthetic"] or made.synthetic, made)


#: How checks of a material begin that results from it have as notes.
_IN_RESULTS = ("Superposition", "Storage against loss", "Fit of the spectrum")


def tree_of(rubber: Rubber) -> DataTree:
    """Return the data sets of a material made of data, which its checks are about."""
    import xarray

    from viscofric.study.rubber_datasets import rubber_groups

    return xarray.DataTree.from_dict(rubber_groups(rubber))


def _named(name: str) -> NamedRubber:
    if Path(name).suffix.lower() == ".toml":
        from viscofric.study.make_rubber import make_rubber
        from viscofric.study.run_file.study import load_study

        study = load_study(name)
        rubber = make_rubber(study.material)
        print_notes(rubber.notes)
        print_doubtful_checks(tree_of(rubber), but=_IN_RESULTS)
        synthetic = rubber.synthetic or study.data_origin == "synthetic"
        return NamedRubber(
            rubber.material, rubber.material.name or f"the rubber of {Path(name).name}", synthetic, rubber
        )
    from viscofric.rheology.catalogue import is_synthetic

    material = find_rubber(name)
    return NamedRubber(material, material.name or f"the rubber of {Path(name).name}", is_synthetic(material))


def chosen_layer(parameters: dict[str, Any]) -> Layer | None:
    """Return the layer of the options; none for a half-space."""
    if parameters.get("layer") is None:
        if parameters.get("sliding_base"):
            raise click.UsageError("--sliding-base is for --layer only; a half-space has no base.")
        return None
    from viscofric.contact.bodies import Layer

    return Layer(parameters["layer"], not parameters["sliding_base"])


shift_factor_options = column_options(
    "'log10_shift_factor=lg'", "shift-factor-", "Of the shift factors: ", table="material.shift_factor_"
)
reading_options = together(
    key("material.deformation"),
    key("material.temperature", metavar="T", multiple=True),
    key("material.modulus_unit", metavar="UNIT"),
    column_options("'frequency=f in Hz'"),
    heading="Reading of the files",
)


def find_rubber(name: str, parameter: str = "material", **units: Any) -> Material:
    """Return the rubber of a file, else of the catalogue, and print what a card leaves open and its fit has noted.

    `units`: those of `open_card` that a card does not state.
    """
    material, notes = rubber_of(name, parameter, **units)
    print_notes(notes)
    return material


def rubber_of(name: str, parameter: str = "material", **units: Any) -> tuple[Material, list[str]]:
    """Return the rubber of a file, else of the catalogue, and what a card leaves open and its fit has noted."""
    from viscofric.errors import not_needed
    from viscofric.rheology.cards import open_card
    from viscofric.rheology.catalogue import catalogue_material

    path = Path(name)
    if not (path.is_file() or path.suffix):
        for unit in (unit for unit, given in units.items() if given):
            raise not_needed(name, unit, "unit-not-needed", "is a material of the catalogue, with units of its own")
        with typed_as({"name": parameter}):
            return catalogue_material(name), []
    card = open_card(path, **units)
    fit = getattr(card.material.spectrum, "fit", None)
    return card.material, [*card.notes, *([] if fit is None else fit.notes)]
