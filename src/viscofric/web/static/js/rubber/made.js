// The rubber of the study, computed when it is first needed and again after each change of [material]; for several steps.
// And what else the steps about the rubber share.

import { Job } from "../jobs.js";
import { sourceKey } from "../page.js";
import { state } from "../state.js";
import * as units from "../units.js";

/** Sources that are tests; files of them are sorted by what they hold, and sweeps and step tests go together. */
export const TESTS = ["dma", "creep", "relaxation", "ramps"];

/** The reference of sweeps until the user, or the sweeps themselves, say another. */
export const FIRST_REFERENCE = "30 degC";

/** Whether the rubber is made of measurements; a predefined one has its own shift factors and spectrum. */
export const isMade = () => ![null, "catalogue", "file"].includes(sourceKey(state.get("material")));

/** The job that makes the material; its part is the material without its bands. */
export const rubber = new Job("rubber", {
  remember: 6,
  inputs: () => {
    const { material, uncertainty, data_origin } = state.study;
    return sourceKey(material) ? { study: { material, uncertainty, data_origin } } : null;
  },
});

/** What is shown of it: also that of earlier inputs, while another one is made. */
export const shownRubber = () => (rubber.error ? null : rubber.result);

/** "60 °C", as the user's units have it. */
export const named = (kelvin) => units.show(kelvin, "temperature");

/** A temperature as a run file writes it, near enough to name one isotherm. */
export const worded = (kelvin) => `${Number((kelvin - 273.15).toFixed(2))} degC`;

/** "0.12 decades" */
export const decades = (value, digits = 2) => `${value.toFixed(digits).replace("-", "−")} decades`;
