/** The rooms of the empty page. */
const room = (notation: string, floor: string, wall: string, more: string) => `orbc: 1
orbifold: "${notation}"
room:
  height: 0.9
  floor:   {checker: [${floor}], cell: 0.2}
  ceiling: {color: linen}
  walls:
    all: {mirror: {reflectance: 0.94}, frame: {width: 0.03, color: goldenrod}}
    2: {mirror: {reflectance: 0.94, tint: "${wall}"}}
objects:
  - cylinder: {radius: 0.06, height: 0.2}
    at: {polar: [0.14, 80deg]}
    material: wood
  - torus_knot: {p: 2, q: 3, radius: 0.08, tube: 0.028}
    name: knot
    at: {polar: [0.14, 80deg], z: 0.2}
    material: {kind: glossy, color: coral}
  - sphere: {radius: 0.08}
    name: ball
    at: {polar: [0.16, 330deg]}
    material: glass
lights:
  - {kind: sphere, at: {polar: [0.2, 330deg], z: 0.72}, radius: 0.035, power: 6, temperature: 3600}
ambient: "#57524a"
white: 4400
exposure: 1.4
${more}`;

export const examples = [
  { notation: '*222', space: 'spherical', where: 'S²×R', chi: '¼', line: 'Three right angles. Eight rooms are the whole sphere.', text: room('*222', 'ivory, "#8a3b3b"', '#ffd9c8', 'camera: {at: {polar: [0.45, 222deg], z: 0.45}, look_at: {polar: [0.2, 42deg], z: 0.36}, fov: 80deg}\ncover: {max_bounces: 14, background: expected}\n') },
  { notation: '*333', space: 'euclidean', where: 'E²×R', chi: '0', line: 'Three angles of 60°. Six rooms meet at each corner.', text: room('*333', 'ivory, "#3d7a5c"', '#d0ffe4', 'camera: {at: {polar: [0.6, 200deg], z: 0.45}, look_at: {polar: [0.2, 42deg], z: 0.36}, fov: 80deg}\ncover: {max_bounces: 12, background: expected}\n').replace('walls:', 'walls:') },
  { notation: '*22222', space: 'hyperbolic', where: 'H²×R', chi: '−¼', line: 'Five right angles. No flat pentagon has them.', text: room('*22222', 'ivory, slategray', '#ffc9a8', 'camera: {at: {polar: [0.52, 222deg], z: 0.42}, look_at: {polar: [0.2, 42deg], z: 0.36}, fov: 80deg}\ncover: {max_bounces: 5, background: expected}\n') },
] as const;
