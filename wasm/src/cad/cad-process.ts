/** What the process that reads a CAD file in Node and its creator agree on. */

/** Number of the pipe on which the process reports its processor time, after its three streams and the channel of messages. */
export const USAGE_PIPE = 4;
