// Loaded before a program and its workers (by NODE_OPTIONS). Limits WebAssembly to TETRAFRONT_TEST_MEMORY
// bytes of memory, as on a machine with little memory.
const most = Number(process.env.TETRAFRONT_TEST_MEMORY);
const PAGE = 65536;
const grow = WebAssembly.Memory.prototype.grow;
WebAssembly.Memory.prototype.grow = function (pages) {
  if (this.buffer.byteLength + PAGE * pages > most) throw new RangeError("no more memory");
  return grow.call(this, pages);
};
