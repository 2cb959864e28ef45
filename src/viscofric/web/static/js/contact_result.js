// Numbers and words of one contact: what is found with its errors, and why the pressure leans forward.

/** Numbers of a result, {label, value, remark} each: the main ones, and the others. */
export function numbersOf(result, units) {
  const of = result.numbers;
  const one = (name, label, kind, digits = 4) => {
    const { value, error } = of[name];
    return { label, value: units.show(value, kind, digits), remark: error ? `± ${units.show(error, kind, 2)}` : "" };
  };
  const plain = (value, unit, digits = 3) => `${units.plainNumber(value, digits)}${unit ? `\u00a0${unit}` : ""}`;
  const row = (label, value, remark = "") => ({ label, value, remark });
  const friction = one("friction_coefficient", "Friction coefficient μ");
  const rubber = [
    row("Shift factor α(T)", plain(of.shift_factor.value)),
    row("Loss tangent tan δ at v/a", plain(of.loss_factor.value)),
    one("storage_modulus", "Storage modulus E′ at v/a", "modulus", 3),
  ];
  const balance = row("Energy balance error", plain(100 * Math.abs(of.energy_balance.value), "%", 2));
  if (result.kind === "rough") {
    const full = of.contact_area_fraction.value > 1 - 1e-9;
    const gap = one("mean_gap", "Mean gap", "length", 3);
    const aside = one("lateral_friction_coefficient", "Lateral force over load");
    const [points, requested] = [of.points.value, of.points_requested.value];
    return {
      key: [
        friction,
        row("Contact area fraction", plain(100 * of.contact_area_fraction.value, "%")),
        one("mean_contact_pressure", "Mean pressure in contact", "pressure", 3),
        full ? { ...gap, value: "none", remark: "full contact" } : gap,
      ],
      others: [
        { ...one("max_pressure", "Maximum pressure", "pressure", 3), remark: "on this grid" },
        Math.abs(of.lateral_friction_coefficient.value) < 1e-12 ? { ...aside, value: "0" } : aside,
        row("Dissipated power", plain(of.power.value, "W/m²")),
        one("slowest_frequency", "Frequency of the longest wave", "angular_frequency", 3),
        one("fastest_frequency", "Frequency of the shortest wave", "angular_frequency", 3),
        ...rubber,
        balance,
        row("Points along an edge", String(points), points < requested ? `of ${requested}: coarse` : ""),
      ],
    };
  }
  const line = result.kind === "line";
  const peak = one("max_pressure", "Maximum pressure", "pressure");
  return {
    key: [
      friction,
      one("indentation", "Indentation", "length"),
      one("contact_area", line ? "Contact width" : "Contact area", line ? "length" : "area"),
      result.peak_resolved ? peak : { ...peak, value: `≥ ${peak.value}`, remark: "not resolved" },
    ],
    others: [
      one("friction_force", line ? "Friction force per length" : "Friction force", line ? "line_load" : "load"),
      row(
        "Dissipated power",
        plain(of.power.value, line ? "W/m" : "W"),
        of.power.error ? `± ${plain(of.power.error, line ? "W/m" : "W", 2)}` : "",
      ),
      one("front", "Leading edge ahead of axis", "length"),
      one("rear", "Trailing edge behind axis", "length"),
      ...(line ? [] : [one("half_width", "Contact half-width", "length")]),
      one("centre_of_pressure", "Centre of pressure ahead of axis", "length", 3),
      one("mean_pressure", "Mean pressure", "pressure", 3),
      one("frequency", "Frequency v/a", "angular_frequency", 3),
      ...rubber,
      balance,
      row("Cells along an edge", String(of.cells.value)),
    ],
  };
}

/** The cause of the asymmetric pressure, in sentences that follow the numbers. */
export function whyItLeans(result, units, noun, radius) {
  const of = result.numbers;
  const speed = units.show(result.speed, "speed");
  const loss = of.loss_factor.value;
  const rubber = `tan δ ${units.plainNumber(loss, 2)} and a storage modulus E′ of ${units.show(of.storage_modulus.value, "modulus")}`;
  if (result.kind === "rough") {
    const ends = [of.slowest_frequency, of.fastest_frequency].map(({ value }) =>
      units.show(value, "angular_frequency", 2),
    );
    return (
      `At ${speed}, the longest wave of the surface deforms the rubber at ${ends[0]}, the shortest at ${ends[1]}, where the rubber has ${rubber}. ` +
      "On the leading flanks the rubber is being compressed and resists; behind the summits it has not recovered yet, and the pressure is lower. " +
      `This difference, over ${units.plainNumber(100 * of.contact_area_fraction.value, 3)} % of the area, causes the friction: μ = ${units.plainNumber(of.friction_coefficient.value, 3)}.`
    );
  }
  const [front, rear, lean] = [of.front, of.rear, of.centre_of_pressure].map(({ value }) =>
    units.show(value, "length"),
  );
  const time = units.show((of.front.value + of.rear.value) / result.speed, "time", 2);
  const start = `The ${noun} passes each point of the rubber in ${time}, which deforms it at v/a = ${units.show(of.frequency.value, "angular_frequency", 2)}. At this frequency the rubber has ${rubber}. `;
  const cause =
    loss < 0.03
      ? "It dissipates little energy at this frequency and recovers almost completely behind the contact, so that the pressure is nearly symmetric. "
      : "Ahead of the axis it is being compressed and resists; behind, it has not recovered yet, and the pressure is lower. ";
  const edges = `The contact therefore extends ${front} ahead of the axis and ${rear} behind it, and the resultant lies ${lean} ahead`;
  const friction = units.plainNumber(of.friction_coefficient.value, 3);
  const lever = radius
    ? `; divided by the radius of ${units.show(radius, "length")}, this is the friction coefficient, μ = ${friction}.`
    : `, where the slope opposes the motion: μ = ${friction}.`;
  return start + cause + edges + lever;
}
