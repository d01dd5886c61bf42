/**
 * npm run models: writes the sample projects to public/models and their list to public/index.json. Run it after
 * you change a shape. The builders are in models/, one file per family.
 */
import { mkdirSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import path from "node:path";
import { inRoot } from "./lib/paths.mjs";
import { models as blade } from "../models/blade.mjs";
import { models as bodies } from "../models/bodies.mjs";
import { models as bracket } from "../models/bracket.mjs";
import { models as engineIntake } from "../models/engine-intake.mjs";
import { models as firstSteps } from "../models/first-steps.mjs";
import { models as flange } from "../models/flange.mjs";
import { models as ground } from "../models/ground.mjs";
import { models as isoparametric } from "../models/isoparametric.mjs";
import { models as missileLauncher } from "../models/missile-launcher.mjs";
import { models as pipeAndFlow } from "../models/pipe-and-flow.mjs";
import { models as pipes } from "../models/pipes.mjs";
import { models as sDuct } from "../models/s-duct.mjs";
import { models as wing } from "../models/wing.mjs";

const opening = "engine-intake";

/** Models in the order of the gallery; the models of a group are consecutive. */
const models = [
  ...engineIntake,
  ...missileLauncher,
  ...firstSteps,
  ...sDuct,
  ...pipes,
  ...flange,
  ...blade,
  ...ground,
  ...isoparametric,
  ...wing,
  ...bracket,
  ...bodies,
  ...pipeAndFlow,
];

const publicFolder = inRoot("public");
const modelsFolder = path.join(publicFolder, "models");

mkdirSync(modelsFolder, { recursive: true });
for (const file of readdirSync(modelsFolder)) rmSync(path.join(modelsFolder, file));
for (const { id, title, blurb, build } of models) {
  writeFileSync(path.join(modelsFolder, `${id}.json`), build().toText(title, blurb));
}
const list = models.map(({ id, title, blurb, group }) => {
  return { id, title, blurb, group, file: `models/${id}.json` };
});
writeFileSync(
  path.join(publicFolder, "index.json"),
  `${JSON.stringify({ opening, models: list }, null, 2)}\n`,
);
