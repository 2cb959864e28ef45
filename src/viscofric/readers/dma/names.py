"""Words in files: names of columns in several languages, and what implies tension or shear."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

import numpy as np

from viscofric.arrays import Array
from viscofric.data import Deformation
from viscofric.errors import DataFileError, not_needed
from viscofric.notes import Note, setting
from viscofric.readers.header_rows import is_number
from viscofric.readers.headings import (
    TEMPERATURE_IN_NAME,
    Column,
    Vocabulary,
    ends_range,
    heading,
    plain_value,
    with_primes,
)
from viscofric.readers.source import Source, converted
from viscofric.readers.table import Table

#: Kind of the moduli and the words of the file that state it, or (None, "").
Said = tuple[Deformation | None, str]


_SORTS = ("", "tensile ", "tension ", "young's ", "shear ", "complex ")

TEMPERATURE = frozenset(
    {"T", "temp", "temp.", "temperature", "sample temperature", "sample temp."}
    | {"temperatur", "probentemperatur", "messtemperatur", "température", "temperatura", "temperatuur", "teplota"}
    | {"lämpötila", "hőmérséklet", "température échantillon", "температура", "温度", "온도"}
    | {"measured temperature", "actual temperature", "specimen temperature", "isttemperatur", "température mesurée"}
    | {"température de l'échantillon", "test temperature", "sıcaklık", "样品温度", "試料温度", "測定温度"}
)
#: Of the programme, read only without a measured temperature.
SET_TEMPERATURE = frozenset(
    {"set temperature", "set temp.", "programme temperature", "program temperature", "nominal temperature"}
    | {"target temperature", "temperature set", "temperature setpoint", "setpoint temperature"}
    | {"solltemperatur", "température de consigne", "temperatura programada", "temperatura impostata"}
)
FREQUENCY = frozenset(
    {"f", "F", "freq", "freq.", "frequency", "frequenz", "prüffrequenz", "messfrequenz", "fréquence", "frecuencia"}
    | {"fréq", "fréquence d'essai"}
    | {"frequenza", "frequência", "frequentie", "frekvens", "frekvence", "częstotliwość", "частота", "频率", "周波数"}
    | {"fréq.", "frekans", "测试频率", "測定周波数", "주파수"}
)
ANGULAR_FREQUENCY = frozenset(
    {"ω", "w", "omega", "angular frequency", "ang. frequency", "angular freq.", "ang. freq.", "angular freq"}
    | {"kreisfrequenz", "winkelfrequenz", "pulsation", "fréquence angulaire", "frecuencia angular", "pulsazione"}
    | {"frequenza angolare", "frequência angular", "hoekfrequentie", "vinkelfrekvens", "częstość kątowa"}
    | {"угловая частота", "角频率", "角周波数"}
)


def _shifted(symbol: str) -> set[str]:
    """Return products of a frequency and the shift factor; names are the same without blanks, dots and brackets."""
    return {mark.join(pair) for mark in ("", "*", "×") for pair in ((symbol, "at"), ("at", symbol))}


#: Of a master curve: shifted to its reference temperature.
REDUCED_FREQUENCY = frozenset(
    {"reduced frequency", "red. frequency", "shifted frequency", "reduzierte frequenz", "freq. (reduced)", "換算周波数"}
    | {"f red", "f r", "f reduced", *_shifted("f"), *_shifted("freq"), *_shifted("frequency")}
)
REDUCED_ANGULAR_FREQUENCY = frozenset(
    {"reduced angular frequency", "red. ang. frequency", "shifted angular frequency", "reduzierte kreisfrequenz"}
    | {"ω red", "ω r", "ω reduced", *_shifted("ω"), *_shifted("omega")}
)
#: Of a master curve: the isotherm that each point was measured in.
ISOTHERM = frozenset({"isotherm", "isotherm temperature", "temperature of the isotherm", "isotherme"})
STORAGE_MODULUS = frozenset(
    {"E'", "G'", "e'", "g'", "e stor", "g stor", "e storage", "g storage", "estor", "gstor"}
    | {sort + name for sort in _SORTS for name in ("storage", "storage modulus", "storage mod.")}
    | {f"{letter}{sort}" for letter in "eg" for sort in ("p", " prime")}
    | {"speichermodul", "speicherschubmodul", "zugspeichermodul", "e-speichermodul", "g-speichermodul"}
    | {"module de conservation", "module conservation", "module de stockage", "module élastique"}
    | {"module de conservation en cisaillement", "módulo de almacenamiento", "módulo elástico", "modulo conservativo"}
    | {"modulo di conservazione", "modulo di accumulo", "módulo de armazenamento", "opslagmodulus", "lagringsmodul"}
    | {"shear modulus (elastic component)"}
    | {"moduł zachowawczy", "модуль накопления", "储能模量", "储存模量", "存储模量", "貯蔵弾性率", "저장탄성률"}
    | {"elastic modulus", "e'-modul", "g'-modul", "paměťový modul", "depolama modülü"}
)
LOSS_MODULUS = frozenset(
    {"E''", "G''", "e''", "g''", "e loss", "g loss", "eloss", "gloss"}
    | {f"{letter}{sort}" for letter in "eg" for sort in ("pp", " double prime", " doubleprime")}
    | {sort + name for sort in _SORTS for name in ("loss", "loss modulus", "loss mod.")}
    | {"verlustmodul", "verlustschubmodul", "zugverlustmodul", "e-verlustmodul", "g-verlustmodul"}
    | {"module de perte", "module perte", "module de dissipation", "module visqueux", "module de perte en cisaillement"}
    | {"módulo de pérdida", "módulo de pérdidas", "módulo viscoso", "modulo dissipativo", "modulo di perdita"}
    | {"shear modulus (viscous component)"}
    | {"módulo de perda", "verliesmodulus", "förlustmodul", "moduł stratności", "модуль потерь"}
    | {"损耗模量", "损失模量", "損失弾性率", "손실탄성률"}
    | {"viscous modulus", "e''-modul", "g''-modul", "ztrátový modul", "kayıp modülü"}
)
COMPLEX_MODULUS = frozenset(
    {"|E*|", "|G*|", "E*", "G*", "|e*|", "|g*|", "e*", "g*"}
    | {"shear modulus (complex component)"}
    | {"complex modulus", "dynamic modulus", "absolute modulus", "komplexer modul", "module complexe"}
    | {"módulo complejo", "modulo complesso", "módulo complexo", "复数模量", "复模量", "複素弾性率"}
)
STORAGE_COMPLIANCE = frozenset(
    {"J'", "D'", "j'", "d'", "storage compliance", "shear storage compliance", "tensile storage compliance"}
    | {"speichernachgiebigkeit", "speicherkomplianz", "complaisance de conservation", "储能柔量"}
)
LOSS_COMPLIANCE = frozenset(
    {"J''", "D''", "j''", "d''", "loss compliance", "shear loss compliance", "tensile loss compliance"}
    | {"verlustnachgiebigkeit", "verlustkomplianz", "complaisance de perte", "损耗柔量"}
)
LOSS_TANGENT = frozenset(
    {"tan δ", "tan delta", "tan d", "tg δ", "tg delta", "loss factor"}
    | {"loss tangent", "damping factor", "verlustfaktor", "facteur de perte", "facteur d'amortissement"}
    | {"tangente delta", "tangens delta", "损耗因子", "损耗角正切", "損失正接"}
    | {"factor de pérdida", "fattore di perdita", "fator de perda", "verliesfactor", "förlustfaktor"}
)
PHASE_ANGLE = frozenset(
    {"δ", "delta", "phase", "phase angle", "loss angle", "phase shift", "phase lag"}
    | {"phasenwinkel", "verlustwinkel", "phasenverschiebung", "angle de phase", "angle de perte", "déphasage"}
    | {"ángulo de fase", "angolo di fase", "ângulo de fase", "fasehoek", "位相角", "相位角"}
)
STRAIN_AMPLITUDE = frozenset(
    {"γ", "ε", "γ0", "ε0", "gamma", "complex shear strain", "strain", "strain amplitude", "dynamic strain"}
    | {"oscillation strain", "shear strain"}
    | {"strain dyn", "strain dyn.", "dehnungsamplitude", "dynamische dehnung", "scheramplitude", "dehnung"}
    | {"deformation", "deformationsamplitude", "amplitude de déformation", "déformation", "déformation dynamique"}
    | {"amplitud de deformación", "deformación", "deformazione", "ampiezza di deformazione", "deformação"}
    | {"scherdeformation", "déformation de cisaillement", "deformação de cisalhamento", "deformazione di taglio"}
    | {"déformation en cisaillement", "deformación de cizalla", "deformación de corte", "ひずみ", "歪み", "应变"}
    | {"dyn. strain", "peak strain", "应变幅值"}
)
STEP = frozenset(
    {"set", "step", "action name", "segment number", "segment", "interval", "sweep", "schritt", "abschnitt"}
    | {"intervalle", "étape", "paso"}
)

TIME = frozenset(
    {"t", "time", "zeit", "temps", "tiempo", "tempo", "tijd", "tid", "čas", "czas", "время", "时间", "時間"}
    | {"test time", "elapsed time", "messzeit", "durée"}
)
#: Names of a coefficient of friction of any origin, of which no heading says what it contains.
COEFFICIENT = frozenset(
    {"traction coefficient", "traction coeff", "traction coeff.", "friction coefficient", "coefficient of friction"}
    | {"coefficient of traction", "friction coeff", "friction coeff.", "coef. of friction", "cof", "mu", "µ", "μ", "µk"}
    | {f"{sort} {name}" for sort in ("dynamic", "kinetic") for name in ("cof", "friction coefficient")}
    | {"coefficient of dynamic friction", "coefficient of kinetic friction"}
    | {"friction factor", "reibwert", "reibungskoeffizient", "reibungszahl", "coefficient de frottement"}
    | {"coeficiente de fricción", "coefficiente di attrito", "摩擦係数", "摩擦系数"}
    | {"reibbeiwert", "coeficiente de rozamiento", "coeficiente de atrito", "wrijvingscoëfficiënt", "|cof|"}
    | {"коэффициент трения", "współczynnik tarcia", "součinitel tření", "動摩擦係数", "动摩擦系数", "마찰계수"}
)
#: Names of a normal load.
LOAD = frozenset(
    {"load", "normal load", "applied load", "normal force", "Fn", "fn", "F_N", "f_n"}
    | {"last", "normallast", "normalkraft", "anpresskraft"}
    | {"charge", "charge normale", "force normale", "carga", "carga normal", "fuerza normal", "carico", "forza normale"}
    | {"belasting", "normaalkracht", "荷重", "垂直荷重", "载荷", "荷载", "法向力"}
)
#: Names of the force of sliding friction.
FRICTION_FORCE = frozenset(
    {"friction force", "frictional force", "tangential force", "Ff", "ff", "F_f", "f_f", "reibkraft", "reibungskraft"}
    | {"force de frottement", "forza di attrito", "fuerza de fricción", "wrijvingskracht", "摩擦力", "摩擦荷重"}
)
#: Names of columns of tests with a film of fluid, which nothing is computed from.
LUBRICANT = frozenset(
    {"lubricant", "viscosity", "dynamic viscosity", "kinematic viscosity", "film thickness", "lambda ratio"}
    | {"hersey number", "hersey", "stribeck number", "sommerfeld number", "gumbel number"}
    | {"schmierstoff", "viskosität", "schmierfilmdicke", "lubrifiant", "viscosité", "lubricante", "viscosidad"}
)
#: Any two of these, or one with tan δ or the phase angle, make a point.
MODULI = ("storage modulus", "loss modulus", "complex modulus")
#: Both, or one with tan δ or the phase angle, make a point where there are no moduli.
COMPLIANCES = ("storage compliance", "loss compliance")
#: The words of DMA tables: name of a quantity in errors -> names of its columns.
DMA = Vocabulary(
    "a DMA table",
    {
        "temperature": TEMPERATURE,
        "frequency": FREQUENCY,
        "storage modulus": STORAGE_MODULUS,
        "loss modulus": LOSS_MODULUS,
        "complex modulus": COMPLEX_MODULUS,
        "storage compliance": STORAGE_COMPLIANCE,
        "loss compliance": LOSS_COMPLIANCE,
        "tan delta": LOSS_TANGENT,
        "phase angle": PHASE_ANGLE,
        "angular frequency": ANGULAR_FREQUENCY,
        "reduced frequency": REDUCED_FREQUENCY,
        "reduced angular frequency": REDUCED_ANGULAR_FREQUENCY,
        "set temperature": SET_TEMPERATURE,
        "isotherm": ISOTHERM,
        "strain amplitude": STRAIN_AMPLITUDE,
        "step": STEP,
    },
    needed=(
        ("frequency", "angular frequency", "reduced frequency", "reduced angular frequency"),
        (*MODULI, *COMPLIANCES),
    ),
    example="a DMA table has e.g. 'temperature (degC)', 'frequency (Hz)', 'storage modulus (MPa)', "
    "'loss modulus (MPa)'",
    offered=(
        ("temperature", "degC"),
        ("frequency", "Hz"),
        ("storage modulus", "MPa"),
        ("loss modulus", "MPa"),
        ("tan delta", ""),
        ("strain amplitude", "%"),
    ),
    logarithms=True,
    means=frozenset({"temperature", "frequency", "angular frequency", *MODULI, "tan delta", "phase angle"}),
    conditions=("temperature", "frequency"),
    several="titled",
)

#: No rubber is measured as cold as this, K: "2K" is two components.
_COLDEST = 50.0
_SAME_TEMPERATURE = 0.01  # K
_AS_PRINTED = {"C": "°C", "DEGC": "°C", "K": "K"}


def temperature_in_name(name: str) -> float | None:
    """Return the temperature in the name of a file or sheet, such as ``"foam_dma_-25C"``, K, or None."""
    # A minus sign must follow a space or an underscore: in ``"foam-25C"`` it may be a dash, and ``"foam - 25C"`` has
    # one.
    found = list(TEMPERATURE_IN_NAME.finditer(name))
    if len(found) != 1 or found[0]["dash"] or ends_range(name, found[0].start("number")):
        return None
    one = found[0]
    below_zero = one["minus"] or one["sign"] in ("-", "−", "–")
    kelvin = converted(f"{'-' if below_zero else ''}{one['number']}", one["unit"].replace("_", ""), "K")
    return kelvin if kelvin and kelvin > _COLDEST else None


def unclear_in_name(name: str) -> str:
    """Return words on a name whose temperature was not read, "" where it holds none: ``EPDM 70 - 25 °C``."""
    said = f" (that in the name {name[:80]!r} is not clear: a dash may be a minus sign, or there are several)"
    return said if TEMPERATURE_IN_NAME.search(name) else ""


#: Where there is no column of temperature.
FROM_TITLES = Note(
    "temperature-from-title",
    "No column holds a temperature; temperatures were taken from the headings, or from the line above each table.",
)


def decided(path: str, said: Said, given: Deformation | None) -> Deformation:
    """Return the kind of deformation that a file or the user states: tension and shear differ by a factor of three."""
    kind, by = said
    if kind is not None and given is not None and (kind == "shear") != (given == "shear"):
        problem = f"{by} states {kind}, but deformation={given!r} was requested."
        raise DataFileError(path, problem, code="deformation-contradicts")
    if (known := given or kind) is None:
        raise DataFileError(path, NOT_SAID)
    return known


def states_another(table: Table, given: float | None) -> bool:
    """Return whether a heading, or a line above a table, states another temperature (K) than a given one."""
    # Words above a single table, such as those of a conditioning, are not read as its temperature.
    if table.block is None or given is None:
        return False
    found = temperatures_above(table)
    return any(kelvin and abs(kelvin - given) > _SAME_TEMPERATURE for kelvin in found)


def insist_on_same_temperature(table: Table, given: float, said: str) -> None:
    """Refuse a column that the user names though its heading states another temperature (K) than a given one."""
    for one in table.columns:
        kelvin = temperature_in_name(one.heading) if one.given and one.quantity else None
        if kelvin and abs(kelvin - given) > _SAME_TEMPERATURE:
            problem = f"column {one.heading!r} states another temperature than {said}; correct one of them."
            raise table.refused("temperatures-contradict", problem)


#: What a table says whose temperature is not to be given.
TITLES_STATE = "the headings, or the lines above its tables, state the temperatures"


def temperatures_of_titles(table: Table, source: Source | None = None) -> Array | None:
    """Return the temperature of each row, K, by the headings or lines above tables; None if one of them gives none."""
    if states_another(table, None if source is None else source.temperature):
        raise not_needed(table.path, "temperature", "temperature-not-needed", TITLES_STATE, " for this file")
    if source is not None and source.temperature is not None:
        insist_on_same_temperature(table, source.temperature, "the one given for this file")
    found = temperatures_above(table)
    if table.block is None or None in found:
        return None
    return np.array(found)[table.block - 1]


def known_temperatures(table: Table, place: int | None, source: Source, notes: list[str]) -> Array | None:
    """Return the temperature of each row, K: of a column, of the user, of titles; None where none of these has it."""
    if place is not None:
        if source.temperature is not None:
            problem = f"column {table.columns[place].heading!r} contains the temperatures"
            raise not_needed(table.path, "temperature", "temperature-not-needed", problem, " for this file")
        kelvin = table.values(place, "K", or_missing=True)
        table.insist(~(kelvin <= 0.0), place, "above absolute zero")
        return kelvin
    titled = temperatures_of_titles(table, source)
    if source.temperature is not None:
        notes.append(Note("temperature-given", "No column holds a temperature; it was given by the user."))
        return np.full(len(table.rows), source.temperature)
    if titled is not None:
        notes.append(FROM_TITLES)
    return titled


def temperatures_above(table: Table) -> list[float | None]:
    """Return the temperature of the nearest line above each table that states one, K, None without any."""
    each = [[kelvin for line in title if (kelvin := temperature_of_title(line))] for title in table.titles]
    return [found[-1] if found else None for found in each]


def words_above(table: Table) -> list[str]:
    """Return what may name its specimen above each of several tables, "" for nothing."""
    named = [[line for line in title[:-1] if names_specimen(line)] + [*title[-1:]] for title in table.titles]
    return [", ".join(filter(None, map(_without_temperature, lines))) for lines in named]


def joined_tables(table: Table) -> list[Note]:
    """Return a note on tables, below or beside each other, with other words above them than their temperatures."""
    first, *others = words_above(table) if table.block is not None else [""]
    if not any(words and words != first for words in others):
        return []
    titles = [*dict.fromkeys(filter(None, (first, *others)))]
    shown = ", ".join(repr(title[:80]) for title in titles[:3]) + (" ..." if len(titles) > 3 else "")
    said = f"Tables below or beside each other were read as those of one specimen; above them are {shown}."
    return [Note("tables-joined", said, values={"titles": titles})]


#: What tells nothing of the specimen: numbers of steps and pages, directions of sweeps, dates and times, and what is
#: left around them.
_COUNTED = re.compile(
    r"\b(sweep|step|interval|segment|page|run|action|part|set|schritt|abschnitt|intervall|seite|étape|intervalle|paso)"
    r"[\s:.#-]*\d+(\s*(of|von|de|/)\s*\d+)?|\d{1,4}[-./]\d{1,2}[-./]\d{1,4}|\d{1,2}:\d{2}(:\d{2})?"
    r"|\b(up|down|upwards?|downwards?|ascending|descending|increasing|decreasing|forwards?|reverse|backwards?|heating|cooling"
    r"|aufwärts|abwärts|montée|descente)\b|\b(T|temp\w*)\.?\s*[=:]?\s*$",
    re.IGNORECASE,
)


def _without_temperature(cells: Sequence[str]) -> str:
    """Return the words above a table that may name its specimen."""
    filled = _as_one_cell([cell.strip() for cell in cells if cell.strip()])
    if filled and DMA.quantity(heading(filled[0].rstrip(":= ")).name) in ("temperature", "set temperature"):
        return ""
    left = _COUNTED.sub(" ", TEMPERATURE_IN_NAME.sub(r"\g<mark> ", " ".join(filled)))
    left = re.sub(r"[(\[][^\w()\[\]]*[)\]]", " ", left)  # "(20 °C, up)"
    return " ".join(left.split()).strip(" :;,=@-–") if re.search(r"[^\W\d_]", left) else ""


def temperature_of_title(cells: Sequence[str]) -> float | None:
    """Return the temperature in a line above a table, such as ``T = 25 °C`` or ``Temperature (°C)`` and ``25``, K."""
    return temperature_in_name(" ".join(_as_one_cell([cell.strip() for cell in cells if cell.strip()])))


def _as_one_cell(filled: list[str]) -> list[str]:
    """Return ``25 °C`` for the cells ``Temperature (°C)`` and ``25``, also in one cell, other cells as they are."""
    filled = list(dict.fromkeys(map(plain_value, filled)))  # merged cells
    label, mark, number = filled[0].replace("=", ":").rpartition(":") if len(filled) == 1 else ("", "", "")
    if mark and is_number(number):
        return one if len(one := _as_one_cell([label.strip(), number.strip()])) == 1 else filled
    if len(filled) == 2 and is_number(filled[1]):
        name = heading(filled[0].rstrip(":= "))
        if DMA.quantity(name.name) == "temperature" and name.unit:
            return [f"{filled[1]} {_AS_PRINTED.get(name.unit.strip('°').upper(), name.unit)}"]
    return filled


#: The problem if nothing decides between tension and shear.
NOT_SAID = Note(
    "no-deformation",
    "does not state whether it was measured in tension or in shear, a factor of 3 in the modulus; set ",
    remedy=setting("material.deformation", "Measured in", "'tension' or 'shear'") + ".",
)

_SPECIMEN = re.compile(
    r"(sample|specimen|material|compound|probe|probekörper|prüfkörper|mischung|échantillon|éprouvette|mélange|muestra|probeta"
    r"|campione|provino|amostra|样品|试样|试件|試料|試験片|시편|시료|образец|próbka|vzorek)"
    r"([\s_-]*(names?|id|no\.?|nr\.?|n°|number|name|nummer|code|#|名称?|编号|番号|번호|명))?",
    re.IGNORECASE,
)


def is_specimen(column: Column) -> bool:
    """Return whether a column names the specimen of each row."""
    return bool(_SPECIMEN.fullmatch(column.name))


def names_specimen(cells: Sequence[str]) -> bool:
    """Return whether a line of words above a table begins with a word for its specimen: ``Sample B``."""
    found = _SPECIMEN.match(" ".join(cells).strip())
    return bool(found and not re.match(r"[^\W\d_]", found.string[found.end() :]))


def insist_on_one_specimen(table: Table, conditions: Array, what: str) -> None:
    """Refuse a table whose column of specimens, or whose lines above its parts, tell apart rows at one condition."""
    # `conditions` has a row of numbers, equal where the conditions are, for each row of the table, NaN where unknown.
    told = [
        (f"column {one.heading!r} holds", [row[place].strip() for row in table.rows], "remove this column")
        for place, one in enumerate(table.columns)
        if not one.quantity and is_specimen(one)
    ]
    if table.block is not None:
        first, *others = words_above(table)
        words = [first or "nothing", *others]
        told.append(("the lines above its tables say", [words[n - 1] for n in table.block], "delete these words"))
    for said, labels, change in told:
        seen: dict[tuple[float, ...], str] = {}
        for row in np.flatnonzero(np.all(np.isfinite(conditions), axis=1)):
            label = labels[row]
            other = seen.setdefault(tuple(conditions[row]), label)
            if label and other and label != other:
                both = " and ".join(one if one == "nothing" else repr(one) for one in (other, label))
                problem = f"{said} {both} at one {what}; keep the rows of one specimen, or {change} "
                raise DataFileError(
                    table.path, f"{problem}to join them.", int(table.lines[row]), code="several-specimens"
                )


_SHEAR_WORDS = r"shear|schub|scher|cisaillement|cizall|cortante|taglio|cisalh|сдвиг"
_SHEAR = re.compile(rf"\|?g['*\s]|j'|g-|gpp?\s|gstor|gloss|.*((?<![a-z])g['*]|{_SHEAR_WORDS})")
_TENSION = re.compile(
    r"\|?e['*\s]|d['\s]|e-|epp?\s|estor|eloss|.*((?<![a-z])e['*]|tensi|young|zug|traction|tracción|trazione|tração)"
)
_SHEARED = re.compile(_SHEAR_WORDS)

# Instruments give every modulus the same name, so the sample holder decides between E and G.  Plates shear in rotation;
# if they compress, in axial oscillation, there is a column of force, or a word for it.
_PLATES = re.compile(
    r"parallel[ -]?plat|plates?[ /–-]+plates?\b|platte[ /–-]+platte|plan[ /–-]+plan\b|(plaques|plateaux) parall"
    r"|(placas|pratos) paralel|piatti paralleli|\bPP ?-?\d",
    re.IGNORECASE,
)
_SHEARING = re.compile(
    rf"\b(torsion|cone|kegel|concentric|couette|double gap|(CP|CC|DG) ?-?\d)|{_SHEAR_WORDS}", re.IGNORECASE
)
_BENDING = re.compile(r"cantilever|\bbend|flexion|flexural|\bbiege|(three|3)[ -]?point|\bTPB\b", re.IGNORECASE)
_COMPRESSING = re.compile(r"compress|kompression|\bdruck", re.IGNORECASE)
_STRETCHING = re.compile(
    r"\b(tension|tensile|traction|films?\b|fib(er|re)|extension|axial|(TPB|UXF|SER)\b)"
    r"|compress|kompression|cantilever|\bbend|flexion|flexural|(three|3)[ -]?point|\b(zug|biege|druck)",
    re.IGNORECASE,
)
#: Labels of lines and sheets, outside the table, that name the sample holder.
_TOOL_LABEL = re.compile(
    r"g[eé]om[eé]tr|clamp|fixture|einspannung|probenhalter|\btool\b|\bmode\b|deformation"
    r"|(measuring|measurement) (system|cell|device|body)|mess(system|zelle|körper|geometrie)"
    r"|syst[eè]me de mesure|sistema de (medi|medi[cç])|sistema di misura",
    re.IGNORECASE,
)
_TORQUE = re.compile(
    r"(oscillation |oscillatory )?torque( amplitude)?|drehmoment|moment de torsion|couple|momento torcente"
    r"|par de torsión|torque oscilatorio"
)
_FORCE = re.compile(
    r"((oscillation|oscillatory|dynamic|drive) )?force( amplitude)?|(dynamische )?kraft|force dynamique"
)


def is_load(name: str) -> bool:
    """Return whether a column of this name holds a torque or a force of the oscillation."""
    return bool(_TORQUE.fullmatch(name.lower()) or _FORCE.fullmatch(name.lower()))


def deformation_of(name: str) -> Deformation | None:
    """Return whether a modulus of this name is tensile or shear, None if the name does not state it."""
    lower = with_primes(name).lower() + " "
    if _SHEAR.match(lower):
        return "shear"
    return "tension" if _TENSION.match(lower) else None


def tool_says(texts: Iterable[tuple[str, str]], *, axial: bool = False) -> Said:
    """Return the deformation that the sample holder implies."""
    # `texts` are label and value from the head of a file, such as ``("Geometry name", "Shear sandwich")``. `axial`: the
    # columns show an axial oscillation, in which plates do not shear.
    said: dict[bool, Said] = {}  # whether it is shear
    for label, value in texts:
        words = f"{label} {value.strip()[:80]!r}"
        shears = _SHEARING.search(value) or (not axial and _PLATES.search(value))
        if shears:
            said.setdefault(True, ("shear", words))
        if _STRETCHING.search(value):
            said.setdefault(False, (_stretched(value), words))
    return next(iter(said.values())) if len(said) == 1 else (None, "")


def _stretched(holder: str) -> Deformation:
    """Return the deformation in a sample holder that does not shear."""
    if _BENDING.search(holder):
        return "bending"
    return "compression" if _COMPRESSING.search(holder) else "tension"


def tools_in(rows: Iterable[Sequence[str]]) -> list[tuple[str, str]]:
    """Return label and value of those rows of cells that name a sample holder: ``# Clamp: film tension``."""
    found = []
    for row in rows:
        cells = [cell.strip().lstrip("#").strip() for cell in row if cell.strip()]
        label, colon, value = (cells or [""])[0].partition(":")
        value = " ".join([value.strip(), *cells[1:]] if colon else cells[1:])
        if value and len(label) < 60 and _TOOL_LABEL.search(label):
            found.append((label.strip(), value))
    return found


def said_by_columns(
    moduli: Iterable[str], tables: Iterable[Iterable[str]], tools: Iterable[tuple[str, str]] = ()
) -> Said:
    """Decide between E and G by headings and sample holder, once for all tables of a file."""
    # The headings of the moduli come first (with E, the holder separates compression and bending from tension), then
    # the sample holder (see `tools_in`), then a column of shear strain, stress or rate, then a torque without a force.
    # `tables` are the headings of all columns that hold numbers, of each table; a torque counts if each table has one,
    # and so does a column of shear beside a force, which may be of another table.
    for printed in moduli:
        kind = deformation_of(heading(printed).name)
        if kind is not None:
            holder = tool_says(tools, axial=True) if kind == "tension" else (None, "")
            return holder if holder[0] in ("compression", "bending") else (kind, f"the heading {printed[:80]!r}")
    plain = [{" ".join(column.lower().split()): column for column in columns} for columns in tables]
    sheared, torques, forces = (
        [[column for name, column in columns.items() if matches(name)] for columns in plain]
        for matches in (_SHEARED.search, _TORQUE.fullmatch, _FORCE.fullmatch)
    )
    axial = any(forces)
    tool = tool_says(tools, axial=axial)
    if tool[0] is not None:
        return tool
    if all(sheared) or (any(sheared) and not axial):
        return "shear", f"the heading {next(filter(None, sheared))[0][:80]!r}"
    if all(torques) and not axial:
        return "shear", f"the column {torques[0][0]!r}, as only a rotational rheometer writes it"
    return None, ""
