/**
 * Fragment shader function: brightness of a flat facet. The normal comes from screen derivatives of the position, so
 * no normals are stored or updated. The light moves with the camera: facets that face the viewer are brightest.
 */
export const facetLight = /* glsl */ `
  float facetLight(vec3 viewPosition) {
    vec3 normal = normalize(cross(dFdx(viewPosition), dFdy(viewPosition)));
    vec3 toEye = normalize(-viewPosition);
    vec3 keyLight = normalize(vec3(-0.35, 0.55, 0.75));
    return 0.42 + 0.38 * abs(dot(normal, toEye)) + 0.26 * max(dot(normal, keyLight), 0.0);
  }
`;

/**
 * Fragment shader function: strength of element edges at a barycentric position, 0 to 1. If elements shrink to a few
 * pixels, their edges fade out; otherwise they would cover everything.
 */
export const edgeStrength = /* glsl */ `
  float edgeStrength(vec3 barycentric, float width) {
    vec3 spread = fwidth(barycentric);
    vec3 inside = smoothstep(spread * (width - 0.5), spread * (width + 0.5), barycentric);
    float density = max(spread.x, max(spread.y, spread.z));
    float fade = 1.0 - smoothstep(0.22, 0.6, density);
    return 0.8 * fade * (1.0 - min(inside.x, min(inside.y, inside.z)));
  }
`;

/** Clip position outside the view: a primitive whose vertices all lie there is not drawn. */
export const culled = "vec4(0.0, 0.0, 2.0, 1.0)";
