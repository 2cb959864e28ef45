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
ROUGH = {f"rough, {points}²": points for points in (128, 256)}


def seconds(contact: str, speeds: int, **more: vf.Heating) -> float:
    """Return the CPU time of a curve of the SYNTHETIC fluoroelastomer from 1 mm/s to 1 m/s."""
    rubber, start = vf.synthetic_fluoroelastomer(), time.process_time()
    asked = {"speeds": np.geomspace(1e-3, 1.0, speeds), "temperatures": "30 degC", **more}
    if contact in ROUGH:
        points = ROUGH[contact]
        spacing = 1e-3 / points
        surface = vf.self_affine(0.8, shape=(points, points), spacing=spacing, shortest=8e-5, rms_slope=0.2, seed=1)
        start = time.process_time()
        vf.predict_rough_friction(rubber, surface, pressure="0.2 MPa", **asked)
    else:
        indenter, load = CONTACTS[contact]
        vf.predict_friction(rubber, indenter, load=load, **asked)
    return time.process_time() - start


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--speeds", type=int, default=60)
    parser.add_argument("--repeat", type=int, default=3, help="curves of each kind, of which the quickest counts")
    parser.add_argument("--json", type=Path)
    asked = parser.parse_args()
    rows = []
    print("contact      rubber at  isothermal (s)  heated (s)  ratio")
    for contact in (*CONTACTS, *ROUGH):
        cold = min(seconds(contact, asked.speeds) for _ in range(asked.repeat))
        for average in ("contact", "loss"):
            heating = vf.Heating(
                rubber=RUBBER,
                counterface=PTFE,
                coulomb=0.45,
                slip="0.1 m/s",
                average=average,
                nominal_radius="5 mm" if contact in ROUGH else None,
            )
            hot = min(seconds(contact, asked.speeds, heating=heating) for _ in range(asked.repeat))
            rows.append({"contact": contact, "average": average, "isothermal": cold, "heated": hot})
            print(f"{contact:12} {average:9} {cold:15.2f} {hot:11.2f} {hot / cold:6.2f}")
    if asked.json is not None:
        asked.json.write_text(json.dumps({"speeds": asked.speeds, "rows": rows}, indent=1))


if __name__ == "__main__":
    main()
