"""Cost of friction curves of contacts that their own friction heats, over that of isothermal curves.

python benchmarks/friction/heated.py --speeds 60 --json heated.json
"""

from __future__ import annotations

import argparse
import json
import time
from pathlib import Path

import numpy as np

import viscofric as vf

RUBBER = vf.ThermalProperties("0.3 W/m/K", "1200 kg/m**3", "1500 J/kg/K", "rubber")
PTFE = vf.ThermalProperties("0.25 W/m/K", "2170 kg/m**3", "1010 J/kg/K", "PTFE")
CONTACTS = {"ball": (vf.Ball("9.525 mm"), "5 N"), "cylinder": (vf.Cylinder("9.525 mm"), "500 N/m")}


def seconds(contact: str, speeds: int, **more: vf.Heating) -> float:
    """Return the CPU time of a curve of the SYNTHETIC fluoroelastomer from 1 mm/s to 1 m/s."""
    indenter, load = CONTACTS[contact]
    start = time.process_time()
    vf.predict_friction(
        vf.synthetic_fluoroelastomer(), indenter, speeds=np.geomspace(1e-3, 1.0, speeds), temperatures="30 degC",
        load=load, **more,
    )  # fmt: skip
    return time.process_time() - start


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--speeds", type=int, default=60)
    parser.add_argument("--json", type=Path)
    asked = parser.parse_args()
    rows = []
    print("contact   rubber at  isothermal (s)  heated (s)  ratio")
    for contact in CONTACTS:
        seconds(contact, 2)  # imports and plans of FFTs
        cold = seconds(contact, asked.speeds)
        for average in ("contact", "loss"):
            heating = vf.Heating(rubber=RUBBER, counterface=PTFE, coulomb=0.45, slip="0.1 m/s", average=average)
            hot = seconds(contact, asked.speeds, heating=heating)
            rows.append({"contact": contact, "average": average, "isothermal": cold, "heated": hot})
            print(f"{contact:9} {average:9} {cold:15.2f} {hot:11.2f} {hot / cold:6.2f}")
    if asked.json is not None:
        asked.json.write_text(json.dumps({"speeds": asked.speeds, "rows": rows}, indent=1))


if __name__ == "__main__":
    main()
