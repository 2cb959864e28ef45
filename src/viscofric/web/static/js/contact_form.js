// The form of a contact: shape, load, layer, speeds and temperatures, all of them keys of the study's document.

import { uploadFiles } from "./api.js";
import { Form } from "./fields.js";
import { attempts, page } from "./page.js";
import { computed, html, view } from "./reactive.js";
import { shapeOf, state } from "./state.js";
import { Card, Drop, Notes } from "./views.js";

const POINTS = ["ball", "ellipsoid", "cone"]; // whose loads are forces

const shape = computed(() => shapeOf(state.study));
const left = new Map(); // what the study had of other shapes, as long as the page is open

function become(next) {
  const { indenter, surface, conditions } = state.study;
  const { load, pressure, direction, ...others } = conditions ?? {};
  left.set(shape.value, { indenter, surface, load, pressure });
  const begun = left.get(next) ?? page.start.shapes[next];
  // point contacts share their load; that of a line is per length
  const shares = [shape.value, next].every((one) => POINTS.includes(one));
  const loads = { load: (shares && load) || begun.load, pressure: begun.pressure };
  const kept = Object.fromEntries(Object.entries({ ...others, ...loads }).filter(([, value]) => value !== undefined));
  state.change({ indenter: begun.indenter, surface: begun.surface, conditions: kept });
}

const [attempt, failed] = attempts();
const bring = (files) =>
  attempt(async () => {
    const [name] = await uploadFiles(files.slice(0, 1));
    state.set("surface.file", name);
    return `${name} was uploaded.`;
  });

export const ContactForm = view(() => {
  const { shape: shapes, scan, load, conditions, interface: dry, heating } = page.start.forms;
  const [which, ...sizes] = shapes;
  return html`
    <${Card} title="Indenter or surface">
      <${Form} of=${[{ ...which, shown: () => shape.value, onChange: become }, ...sizes]} />
      ${
        shape.value === "scan" &&
        html`<${Drop} label="Drop a height map" help="text matrix, x y z points, or a microscope file" multiple=${false}
            onFiles=${bring} />
          <${Notes} kind="error" list=${[failed.value?.message]} />`
      }
      <${Form} of=${scan} />
      <${Form} of=${load} />
    <//>
    <${Card} title="Speeds and temperatures"><${Form} of=${conditions} /><//>
    <${Card} title="Interface and heat"><${Form} of=${dry} /><${Form} of=${heating} /><//>
  `;
});
