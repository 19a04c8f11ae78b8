/** What the core says of a scene; core.h and describe.h of exporters/html/core hold the meaning of each member. */
export type Numbers = Float32Array | Float64Array | Uint32Array | Uint8Array;

export interface Diagnostic {
  severity: 'error' | 'warning' | 'note';
  code: string;
  message: string;
  hint: string;
  line: number;
  column: number;
  length: number;
  text: string;
}
/** path, kind (0 empty, 1 scalar, 2 list, 3 map), line, column, length, line and column of the key. */
export type Node = [string, number, number, number, number, number, number];

export interface Orbifold {
  notation: string;
  chi: string;
  chi_value: number;
  space: 'spherical' | 'euclidean' | 'hyperbolic' | 'none';
  strip: boolean;
  real: boolean;
  orders: string[];
}
export interface Wall {
  line: number[];
  start: number[];
  along: number[];
  length: number;
  reflects: boolean;
}
export interface RoomReply {
  curvature: number;
  height: number;
  corners: number[][];
  walls: Wall[];
  inradius: number;
  circumradius: number;
  area: number;
  moduli: number;
}
export interface Mirror {
  span: number[];
  height: number[];
  throughput: number[];
}
export interface Material {
  color: number[];
  second: number[];
  pattern: 'plain' | 'checker' | 'marble' | 'wood' | 'granite' | 'texture';
  kind: 'matte' | 'glossy' | 'metal' | 'mirror' | 'glass' | 'emissive';
  cell: number;
  texture: number;
  emission: number;
}
export interface Surface extends Material {
  mirrors: Mirror[];
}
export interface Style extends Material {
  roughness: number;
  index: number;
  cutoff: number;
}
export interface MeshPart {
  style: number;
  part: number;
  name: string;
  lamp: number;
  indices: Uint32Array;
}
export interface Thing {
  name: string;
  shape: string;
  at: number[];
  extent: number;
  top: number;
  material: string;
  pattern: string;
}
export interface Lamp {
  kind: string;
  at: number[];
  power: number[];
}
export interface SceneReply {
  ok: boolean;
  diagnostics: Diagnostic[];
  nodes?: Node[];
  orbifold: Orbifold;
  room: RoomReply;
  shell: { floor: Surface; ceiling: Surface; walls: Surface[] };
  styles: Style[];
  textures: { width: number; height: number; pixels: Uint8Array }[];
  meshes: { positions: Float32Array; normals: Float32Array; colors: Float32Array; coordinates: Float32Array; parts: MeshPart[] };
  objects: Thing[];
  lamps: Lamp[];
  eye: { room_from_eye: number[]; z: number; forward: number[]; right: number[]; up: number[]; fov: number; size: number[] };
  cover: { max_bounces: number; min_weight: number; background: number[]; expected: boolean };
  light: { lit: boolean; exposure: number; ambient: number[] };
}
export interface LightGrid {
  columns: number;
  rows: number;
  reach: number;
  first: number;
}
export interface LightReply {
  done: number;
  all: number;
  first: number;
  floor: LightGrid;
  ceiling: LightGrid;
  walls: number[];
  irradiance: Float32Array;
}
export interface CopiesReply {
  matrices: Float64Array;
  words: Uint8Array;
  lengths: Uint8Array;
  whole: boolean;
}
/** Files of an export; the main one has no name. */
export interface ExportReply {
  diagnostics: Diagnostic[];
  files: { name: string; bytes: Uint8Array }[];
  copies: number;
  triangles: number;
  error_px: number;
}
/** Without triangles the file is none. */
export interface MeshReply {
  diagnostics: Diagnostic[];
  triangles?: number;
}
