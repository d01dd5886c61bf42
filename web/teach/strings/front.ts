/** Texts about the recorded front and the lessons outside their panels: commands, the palette and the status bar. */
import { formatCount } from "../../strings/format";
export const frontStrings = {
  commands: {
    record: "Record the front",
    play: "Play or pause the front",
    forward: "Step of the front forward",
    back: "Step of the front back",
    farForward: (steps: number) => `${steps} steps of the front forward`,
    farBack: (steps: number) => `${steps} steps of the front back`,
    start: "First state of the front",
    end: "Last state of the front",
    close: "Show the model instead of the front",
    lessons: "Lessons",
    mesher: "Be the mesher",
  },
  /** Other words that find commands. */
  words: {
    play: "step animation run pause",
    start: "step first begin rewind",
    end: "step last finish",
    lessons: "learn course tutorial teach students articles help",
    mesher: "game play level learn",
  },
  needsFront: "Record the front first (Mesh ▸ Record the front).",
  group: "Front",
  tab: "Front",
  lens: "Lens",
  goToStep: {
    begin: "step ",
    words: "jump frame seek",
    label: (step: number | null, steps: number | null) =>
      step === null
        ? `Go to step … of the front${steps === null ? "" : ` (0 to ${formatCount(steps)})`}`
        : `Go to step ${step} of the front`,
  },
  /** Words that find what passes a step on. */
  sharing: {
    link: "share url address send pass on collaborate",
    embed: "embed embedded share html iframe website",
    picture: "image png screenshot photo snapshot capture export",
    drawing: "image vector svg screenshot export share",
    animation: "video film movie gif export share",
  },
  lessons: "Lessons",
  lesson: (number: number) => `Lesson ${number}`,
  at: {
    lines: (step: string, steps: string) => `Lines after step ${step} of ${steps}`,
    patches: (step: string, steps: string) => `Fronts of the patches after step ${step} of ${steps}`,
    volume: (step: string, steps: string) => `Front after step ${step} of ${steps}`,
  },
} as const;
