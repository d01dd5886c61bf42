import {
  Color,
  DataTexture,
  LinearFilter,
  NearestFilter,
  RGBAFormat,
  UnsignedByteType,
  type MagnificationTextureFilter,
} from "three";
import { displayColor } from "./uniforms";

/** Texels of a colour ramp. */
const rampLength = 256;

/** Returns a one-row texture that interpolates linearly between the colours. */
export function rampTexture(colors: readonly string[]): DataTexture {
  const stops = colors.map(displayColor);
  const data = new Uint8Array(4 * rampLength);
  const mixed = new Color();
  for (let i = 0; i < rampLength; ++i) {
    const stop = (i / (rampLength - 1)) * (stops.length - 1);
    const low = Math.min(Math.floor(stop), stops.length - 2);
    mixed.copy(stops[low] ?? mixed).lerp(stops[low + 1] ?? mixed, stop - low);
    data.set([mixed.r * 255, mixed.g * 255, mixed.b * 255, 255], 4 * i);
  }
  return rowTexture(data, LinearFilter);
}

/** Returns a one-row texture with one texel per colour. */
export function paletteTexture(colors: readonly string[]): DataTexture {
  const data = colors.map(displayColor).flatMap(({ r, g, b }) => [r * 255, g * 255, b * 255, 255]);
  return rowTexture(Uint8Array.from(data, Math.round), NearestFilter);
}

function rowTexture(data: Uint8Array<ArrayBuffer>, filter: MagnificationTextureFilter): DataTexture {
  const texture = new DataTexture(data, data.length / 4, 1, RGBAFormat, UnsignedByteType);
  texture.minFilter = filter;
  texture.magFilter = filter;
  texture.needsUpdate = true;
  return texture;
}
