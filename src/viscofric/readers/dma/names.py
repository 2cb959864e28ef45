"""What the columns of DMA tables are called, in the languages that instruments and laboratories print."""

from __future__ import annotations

import re
import unicodedata

from viscofric.units import CELSIUS_ZERO

_SORTS = ("", "tensile ", "tension ", "young's ", "shear ", "complex ")

TEMPERATURE = frozenset(
    {"T", "temp", "temp.", "temperature", "sample temperature", "sample temp."}
    | {"temperatur", "probentemperatur", "messtemperatur", "température", "temperatura", "temperatuur", "teplota"}
    | {"lämpötila", "hőmérséklet", "température échantillon", "температура", "温度", "온도"}
)
#: What the programme asked for, taken only where no measured temperature is printed.
SET_TEMPERATURE = frozenset(
    {"set temperature", "set temp.", "programme temperature", "program temperature", "nominal temperature"}
    | {"solltemperatur", "température de consigne", "temperatura programada", "temperatura impostata"}
)
FREQUENCY = frozenset(
    {"f", "freq", "freq.", "frequency", "frequenz", "prüffrequenz", "messfrequenz", "fréquence", "frecuencia"}
    | {"frequenza", "frequência", "frequentie", "frekvens", "frekvence", "częstotliwość", "частота", "频率", "周波数"}
)
ANGULAR_FREQUENCY = frozenset(
    {"ω", "w", "omega", "angular frequency", "ang. frequency", "angular freq.", "ang. freq.", "angular freq"}
    | {"kreisfrequenz", "winkelfrequenz", "pulsation", "fréquence angulaire", "frecuencia angular", "pulsazione"}
    | {"frequenza angolare", "frequência angular", "hoekfrequentie", "vinkelfrekvens", "częstość kątowa"}
    | {"угловая частота", "角频率", "角周波数"}
)
#: Of a master curve: shifted to its reference temperature.
REDUCED_FREQUENCY = frozenset({"reduced frequency", "red. frequency", "shifted frequency", "reduzierte frequenz"})
REDUCED_ANGULAR_FREQUENCY = frozenset(
    {"reduced angular frequency", "red. ang. frequency", "shifted angular frequency", "reduzierte kreisfrequenz"}
)
#: Of a master curve: the isotherm that each point was measured in.
ISOTHERM = frozenset({"isotherm", "isotherm temperature", "temperature of the isotherm", "isotherme"})
STORAGE_MODULUS = frozenset(
    {"E'", "G'", "e'", "g'", "e stor", "g stor", "e storage", "g storage", "estor", "gstor"}
    | {sort + name for sort in _SORTS for name in ("storage", "storage modulus", "storage mod.")}
    | {"speichermodul", "speicherschubmodul", "zugspeichermodul", "e-speichermodul", "g-speichermodul"}
    | {"module de conservation", "module conservation", "module de stockage", "module élastique"}
    | {"module de conservation en cisaillement", "módulo de almacenamiento", "módulo elástico", "modulo conservativo"}
    | {"modulo di conservazione", "modulo di accumulo", "módulo de armazenamento", "opslagmodulus", "lagringsmodul"}
    | {"moduł zachowawczy", "модуль накопления", "储能模量", "貯蔵弾性率"}
)
LOSS_MODULUS = frozenset(
    {"E''", "G''", "e''", "g''", "e loss", "g loss", "eloss", "gloss"}
    | {sort + name for sort in _SORTS for name in ("loss", "loss modulus", "loss mod.")}
    | {"verlustmodul", "verlustschubmodul", "zugverlustmodul", "e-verlustmodul", "g-verlustmodul"}
    | {"module de perte", "module perte", "module de dissipation", "module visqueux", "module de perte en cisaillement"}
    | {"módulo de pérdida", "módulo de pérdidas", "módulo viscoso", "modulo dissipativo", "modulo di perdita"}
    | {"módulo de perda", "verliesmodulus", "förlustmodul", "moduł stratności", "модуль потерь"}
    | {"损耗模量", "損失弾性率"}
)
COMPLEX_MODULUS = frozenset(
    {"|E*|", "|G*|", "E*", "G*", "|e*|", "|g*|", "e*", "g*"}
    | {"complex modulus", "dynamic modulus", "absolute modulus", "komplexer modul", "module complexe"}
    | {"módulo complejo", "modulo complesso", "módulo complexo"}
)
LOSS_TANGENT = frozenset(
    {"tan δ", "tanδ", "tan(δ)", "tan delta", "tan d", "tandelta", "tan(delta)", "tan-delta", "loss factor"}
    | {"loss tangent", "damping factor", "verlustfaktor", "facteur de perte", "facteur d'amortissement"}
    | {"factor de pérdida", "fattore di perdita", "fator de perda", "verliesfactor", "förlustfaktor"}
)
STRAIN_AMPLITUDE = frozenset(
    {"γ", "ε", "γ0", "ε0", "strain", "strain amplitude", "dynamic strain", "oscillation strain", "shear strain"}
    | {"strain dyn", "strain dyn.", "dehnungsamplitude", "dynamische dehnung", "scheramplitude", "dehnung"}
    | {"deformation", "deformationsamplitude", "amplitude de déformation", "déformation", "déformation dynamique"}
    | {"amplitud de deformación", "deformación", "deformazione", "ampiezza di deformazione", "deformação"}
)
STEP = frozenset({"set", "step", "segment", "interval", "sweep", "schritt", "abschnitt", "intervalle", "étape", "paso"})

#: What each column may hold, by the word that errors use for it.
QUANTITIES = {
    "temperature": TEMPERATURE,
    "set temperature": SET_TEMPERATURE,
    "angular frequency": ANGULAR_FREQUENCY,
    "frequency": FREQUENCY,
    "reduced angular frequency": REDUCED_ANGULAR_FREQUENCY,
    "reduced frequency": REDUCED_FREQUENCY,
    "storage modulus": STORAGE_MODULUS,
    "loss modulus": LOSS_MODULUS,
    "complex modulus": COMPLEX_MODULUS,
    "tan delta": LOSS_TANGENT,
    "strain amplitude": STRAIN_AMPLITUDE,
    "step": STEP,
}

# "foam_-25C", "T 25 °C": a number and its unit, set apart from other letters and digits.
_TEMPERATURE_IN_NAME = re.compile(
    r"(?:(?P<mark>^|[\s_=(,;])(?P<sign>[+−-]?)|(?P<dash>-))(?P<number>\d+(?:[.,]\d+)?)\s?_?"
    r"(?P<unit>°C|degC|deg_C|C|K)(?![^\W_])"
)


def quantity(name: str) -> str | None:
    """Return what a column of this name holds, in the words of `QUANTITIES`, or None.

    Parameters
    ----------
    name : str
        A heading without its unit, see `viscofric.readers.table.Column`; capitals matter for one letter only.
    """
    plain = unicodedata.normalize("NFC", name)
    for what, names in QUANTITIES.items():
        if plain in names or (len(plain) > 1 and plain.lower() in names):
            return what
    return None


def temperature_in_name(name: str) -> float | None:
    """Return the one temperature that the name of a file or sheet tells, K, or None.

    Parameters
    ----------
    name : str
        Without folder and ending, such as ``"foam_dma_-25C"``.  A minus must follow a blank or underscore:
        in ``"foam-25C"`` it may be a dash.
    """
    found = list(_TEMPERATURE_IN_NAME.finditer(name))
    if len(found) != 1 or found[0]["dash"]:
        return None
    one = found[0]
    number = float(one["number"].replace(",", ".")) * (-1.0 if one["sign"] in ("-", "−") else 1.0)
    kelvin = number if one["unit"] == "K" else number + CELSIUS_ZERO
    return kelvin if kelvin > 0.0 else None
