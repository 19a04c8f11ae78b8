import marchText from './march.glsl';
import objectFragment from './object.frag';
import objectVertex from './object.vert';
import roomFragment from './room.frag';
import roomVertex from './room.vert';
import solidText from './solid.glsl';
import spaceText from './space.glsl';

/** What a program depends on. Walls and colors are uniforms: no edit rebuilds a program, unless one of these changes. */
export interface ProgramKey {
  curvature: number;
  walls: number;
  mirrorsPerWall: number;
  /** Mirrors cover parts of walls, or some wall is plain: then walls have points of their own. */
  partial: boolean;
  /** Pixels write the walls that turned their ray back, and copies are drawn where these begin with their word. */
  coded: boolean;
  solidShell: boolean;
  texturedShell: boolean;
}

/** How the surface of a mesh looks, as far as programs differ by it. */
export interface Look {
  /** 0 colors of vertices, 2 marble, 3 wood, 4 granite, 5 texture. */
  pattern: number;
  /** 0 it shows the light that arrives, or its own; 1 metal, 2 mirror, 3 glass. */
  shine: number;
  /** It reaches out of the room, and is not seen there. */
  inRoom: boolean;
}

export const nameOf = (key: ProgramKey, look?: Look): string => JSON.stringify([key, look]);

function head(key: ProgramKey): string {
  const lines = [
    '#version 300 es',
    `#define K ${key.curvature}`,
    `#define N ${key.walls}`,
    `#define MIRRORS ${key.mirrorsPerWall}`,
    `#define M ${key.walls * key.mirrorsPerWall}`,
    `#define S ${key.walls + 2}`,
    `#define NONE ${key.curvature > 0 ? '-1e30' : key.curvature < 0 ? '1.0' : '1e-9'}`,
    '#define NEAR 0.004',
    '#define FAR 60.0',
    '#define REFLECTED 4',
  ];
  if (key.partial) lines.push('#define PARTIAL');
  if (key.coded) lines.push('#define CODED');
  if (key.solidShell) lines.push('#define SOLID');
  if (key.texturedShell) lines.push('#define TEXTURED');
  return lines.join('\n') + '\n';
}

/** The next wall of a ray is that of the largest -l(v) / l(p), which is cotκ of its distance. Unrolled: variable indices are slow. */
function wallLoop(walls: number): string {
  const lines: string[] = [];
  for (let i = 0; i < walls; ++i)
    lines.push(
      `a = max(1e-9, dot(wall_line[${i}], p)); t = -dot(wall_line[${i}], v) / a; if (t > best) { best = t; hit = ${i}; line = wall_line[${i}]; }`,
    );
  return lines.join('\n    ');
}

function marchOf(key: ProgramKey): string {
  return marchText.replace('WALLS', () => wallLoop(key.walls));
}

export function roomSources(key: ProgramKey): [string, string] {
  return [head(key) + roomVertex, head(key) + spaceText + (key.solidShell ? solidText : '') + marchOf(key) + roomFragment];
}

export function objectSources(key: ProgramKey, look: Look): [string, string] {
  const own = head(key) + `#define PATTERN ${look.pattern}\n#define SHINE ${look.shine}\n` + (look.inRoom ? '#define IN_ROOM\n' : '');
  const solid = (look.pattern >= 2 && look.pattern <= 4) || (look.shine > 0 && key.solidShell) ? solidText : '';
  const march = look.shine > 0 ? marchOf({ ...key, coded: false }) : '';
  return [own + 'precision highp float;\nprecision highp int;\n' + objectVertex, own + spaceText + solid + march + objectFragment];
}
