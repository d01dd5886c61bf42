import { Color, type ShaderMaterial, type Texture } from "three";

/**
 * Sets the uniforms of the view's shaders. All shaders work in display (sRGB) values, so that a theme colour appears
 * on the screen as written.
 */

/** Returns a CSS colour without three's conversion to linear light. */
export function displayColor(css: string): Color {
  const color = new Color();
  color.setStyle(css);
  return color.convertLinearToSRGB();
}

/** Sets a colour uniform from a CSS colour. */
export function setColor(material: ShaderMaterial, uniform: string, css: string): void {
  const target = material.uniforms[uniform];
  if (target?.value instanceof Color) target.value.copy(displayColor(css));
}

export function setTexture(material: ShaderMaterial, uniform: string, value: Texture | null): void {
  const target = material.uniforms[uniform];
  if (target) target.value = value;
}

export function setNumber(material: ShaderMaterial, uniform: string, value: number): void {
  const target = material.uniforms[uniform];
  if (target) target.value = value;
}
