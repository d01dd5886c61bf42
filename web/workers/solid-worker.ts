/** Makes solids of features by the kernel, which is loaded with the first one. */
import { importKernel, type FeatureKernel } from "tetrafront/internal";
import { kernelFiles } from "./cad-library";
import { serveCalls } from "./serve-calls";
import { solidCalls } from "./solid-calls";
import type { SolidProtocol } from "./solids";

serveCalls<SolidProtocol>(solidCalls(() => importKernel<FeatureKernel>(kernelFiles)));
