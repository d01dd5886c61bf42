/** Reads a CAD file in a worker of its own, which is terminated when the file is read or the signal is aborted. */
import { cadHost } from "#cad-host";
import { untilCancelled } from "../calls/cancelling.js";
import { cadLibrary } from "./cad-library.js";
import type { CadWorker } from "./cad-host.js";
import { startFailure } from "./crash.js";
import type { CadProgress, CadReply, CadRequest, CadTimeout } from "./protocol.js";

export const notLoadedRemedy = cadHost.remedyFor;

/**
 * Seconds after which the worker is terminated: OpenCascade cannot be interrupted or asked how far it is, and some damaged
 * files keep it busy forever. They are processor time where that is known, so that a busy machine does not make a sound file count as
 * damaged. On a very busy machine, real parts took at most 25 s, and 220 s per megabyte; files of a few
 * kilobytes took less than 1 s.
 */
const LIMIT = { base: 30, perMegabyte: 500 } as const;
const SMALL_LIMIT = { base: 6, perMegabyte: 700 } as const;
const MEGABYTE = 1e6;
/** Bytes of files that contain a part, and not an assembly of many: the limit of small files holds for them. */
const SMALL_FILE = 34_000;

/** Time of the clock / limit, after which a worker is terminated that gets little of the processor. */
const LONGEST = 10;

/** Seconds that the library gets to be loaded: in a browser, 7 MB from a server, which take 140 s at 400 kbit/s. */
const LOADING = 300;

export function isSmallFile(bytes: number): boolean {
  return bytes < SMALL_FILE;
}

/** Returns the longest time that the worker gets for a file, in seconds. */
export function secondsFor(bytes: number): number {
  const most = ({ base, perMegabyte }: typeof LIMIT | typeof SMALL_LIMIT) =>
    base + (perMegabyte * bytes) / MEGABYTE;
  return Math.ceil(isSmallFile(bytes) ? most(SMALL_LIMIT) : most(LIMIT));
}

/** Returns the longest time for a file that has been read before, and is triangulated more finely. */
export function secondsForFiner(bytes: number): number {
  return Math.max(secondsFor(bytes), LIMIT.base);
}

/** The longest times that the worker gets, in seconds. */
interface CadLimits {
  readonly reading?: number;
  readonly loading?: number;
  /** For the search for faces that solids share, and what follows. */
  readonly sharing?: number;
}

type CadQuestion = Omit<CadRequest, "library" | "sharesFaces">;

/**
 * Resolves with the reply of the worker; a crash of the worker and the end of its times are replies, too. If it does not get to the
 * end of the search for faces that solids share, another one reads the file without. A question with the bare shape needs no
 * search. Rejects with a `MesherError` of code `cancelled` if the signal is aborted.
 */
export async function askForCad(
  question: CadQuestion,
  signal: AbortSignal | undefined,
  limits: CadLimits = {},
): Promise<CadReply> {
  const { reply, hasShared } = await answerTo({ ...question, sharesFaces: true }, signal, limits);
  if (reply.kind === "read" || !hasShared) return reply;
  const { reply: apart } = await answerTo({ ...question, sharesFaces: false }, signal, limits);
  return apart.kind === "read" ? { ...apart, areApart: true } : apart;
}

/** `hasShared`: whether the worker has begun to search for faces that solids share. */
async function answerTo(
  request: CadQuestion & Pick<CadRequest, "sharesFaces">,
  signal: AbortSignal | undefined,
  { reading = secondsFor(request.bytes.length), loading = LOADING, sharing = reading }: CadLimits,
): Promise<{ readonly reply: CadReply; readonly hasShared: boolean }> {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let worker: CadWorker | undefined;
  let hasShared = false;
  try {
    const reply = await untilCancelled(
      () =>
        new Promise<CadReply>((resolve) => {
          const stopAfter = (seconds: number, kind: CadTimeout["kind"]) => {
            const [begin, before] = [performance.now(), worker?.processorSeconds?.()];
            const wait = (left: number) => {
              clearTimeout(timer);
              timer = setTimeout(stopOrWait, left * 1000);
            };
            const stopOrWait = () => {
              const now = worker?.processorSeconds?.();
              const left = before === undefined || now === undefined ? 0 : seconds - (now - before);
              const longest = LONGEST * seconds - (performance.now() - begin) / 1000;
              if (Math.min(left, longest) <= 0) resolve({ kind, seconds });
              else wait(Math.min(left, longest));
            };
            wait(seconds);
          };
          const onReply = (message: CadReply | CadProgress) => {
            if (message.kind === "loaded") stopAfter(reading, "timed-out");
            else if (message.kind === "sharing") {
              hasShared = true;
              stopAfter(sharing, "timed-out");
            } else resolve(message);
          };
          stopAfter(loading, "loading-timed-out");
          try {
            worker = cadHost.start({ onReply, onCrash: resolve });
            worker.post({ ...request, library: cadLibrary() });
          } catch (failure) {
            resolve(startFailure(failure));
          }
        }),
      signal,
    );
    return { reply, hasShared };
  } finally {
    clearTimeout(timer);
    worker?.terminate();
  }
}
