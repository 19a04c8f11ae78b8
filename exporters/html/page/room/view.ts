/** The picture of the room by WebGL2. First a pass over all pixels marches their rays through the real mirrors: it is exact for floor,
 *  ceiling and walls at any depth. Then objects and frames follow as instances of the room's copies, mapped by the log map. */
import type { CopiesReply, LightReply, Material, MeshPart, SceneReply } from '../state/reply';
import { beams, codeOf, groupCopies, wallKinds, type Copy, type WallKinds } from './copies';
import { axes, type Eye } from './eye';
import * as g from './geometry';
import { nameOf, objectSources, roomSources, type Look, type ProgramKey } from './shaders';

interface Program {
  program: WebGLProgram;
  at: (name: string) => WebGLUniformLocation | null;
}
interface Mesh {
  part: MeshPart;
  vao: WebGLVertexArrayObject;
  levels: { first: number; count: number; error: number }[];
  /** A ball around the part: w, x, y, z, and its radius. */
  centre: number[];
  radius: number;
}
/** How a picture is to be drawn. */
export interface Shot {
  eye: Eye;
  /** Horizontal field of view, radians. */
  fov: number;
  /** The principal point, as a share of half the picture to the right and up. */
  shift: [number, number];
  /** Pixels of the drawing buffer for one of the canvas. */
  scale: number;
  /** Where a part stands while it is dragged: its number, room from its old place, and how far it is lifted. */
  moved?: { part: number; map: g.Matrix; lifted: number };
  selected?: number;
  /** How fine the levels of detail are. */
  detail: 'exact' | 'rest' | 'moving';
  /** A fraction of a pixel by which the picture is shifted, for smoothing. */
  jitter?: [number, number];
}

const patterns = ['plain', 'checker', 'marble', 'wood', 'granite', 'texture'];
const floatsPerInstance = 13;
const errorPixels = { exact: 0.25, rest: 1, moving: 2 }; // of levels of detail

export class RoomView {
  readonly gl: WebGL2RenderingContext;
  /** There is no graphics card: pictures begin coarse while one walks. */
  readonly isSoftware: boolean;
  private programs = new Map<string, Program>();
  private prepared = new Set<Program>();
  private scene: SceneReply | null = null;
  private key!: ProgramKey;
  private kinds!: WallKinds;
  private group: Copy[] = [];
  private meshes: Mesh[] = [];
  private buffers: WebGLBuffer[] = [];
  private light: WebGLBuffer | null = null;
  private instances: WebGLBuffer;
  private words: WebGLBuffer;
  private textures: WebGLTexture[] = [];
  private white: WebGLTexture;
  private lightMaps: { floor: WebGLTexture; ceiling: WebGLTexture; walls: WebGLTexture; reach: number } | null = null;
  private lightData: Float32Array = new Float32Array();
  private target: { frame: WebGLFramebuffer; second: WebGLFramebuffer; color: WebGLTexture; code: WebGLTexture; depth: WebGLRenderbuffer; width: number; height: number } | null = null;
  private sum: { frame: WebGLFramebuffer; texture: WebGLTexture; width: number; height: number; count: number } | null = null;
  /** What the last picture was made of. */
  counts = { copies: 0, triangles: 0 };
  /** Programs that were built so far: a picture that needs a new one is slow once. */
  built = 0;

  constructor(readonly canvas: HTMLCanvasElement) {
    const gl = canvas.getContext('webgl2', { antialias: false, alpha: false, preserveDrawingBuffer: true, powerPreference: 'high-performance' });
    if (!gl) throw new Error('This browser has no WebGL2.');
    this.gl = gl;
    gl.getExtension('EXT_color_buffer_float');
    const info = gl.getExtension('WEBGL_debug_renderer_info');
    this.isSoftware = /swiftshader|llvmpipe|software/i.test(info ? String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL)) : '');
    this.instances = gl.createBuffer()!;
    this.words = gl.createBuffer()!;
    this.white = this.texture(1, 1, new Uint8Array([255, 255, 255, 255]));
  }

  // ---- what a scene brings ----------------------------------------------------------------------------------------------------

  setScene(scene: SceneReply, copies: CopiesReply): void {
    const { gl } = this;
    const sameVertices = this.scene?.meshes.positions.length === scene.meshes.positions.length;
    this.scene = scene;
    this.kinds = wallKinds(scene);
    const surfaces = [...scene.shell.walls, scene.shell.floor, scene.shell.ceiling];
    this.key = {
      curvature: scene.room.curvature,
      walls: scene.room.walls.length,
      mirrorsPerWall: this.kinds.mirrorsPerWall,
      partial: this.kinds.partial,
      coded: this.kinds.coded,
      solidShell: surfaces.some((s) => ['marble', 'wood', 'granite'].includes(s.pattern)),
      texturedShell: surfaces.some((s) => s.pattern === 'texture' && s.texture >= 0),
    };
    this.group = this.kinds.coded ? [] : groupCopies(scene, copies);
    for (const mesh of this.meshes) gl.deleteVertexArray(mesh.vao);
    for (const buffer of this.buffers) gl.deleteBuffer(buffer);
    for (const texture of this.textures) gl.deleteTexture(texture);
    const { meshes } = scene;
    const lists = [meshes.positions, meshes.normals, meshes.colors, meshes.coordinates];
    const made = lists.map((list) => this.buffer(list, gl.STATIC_DRAW));
    if (!sameVertices || !this.lightData.length) {
      this.lightData = this.firstLight(scene);
      this.lightMaps = null;
    }
    if (this.light) gl.deleteBuffer(this.light);
    this.light = this.buffer(this.lightData.subarray(0, (meshes.positions.length / 4) * 3), gl.DYNAMIC_DRAW);
    this.buffers = [...made];
    this.textures = scene.textures.map((t) => this.texture(t.width, t.height, t.pixels, true));
    this.meshes = meshes.parts.map((part) => this.mesh(part, [...made, this.light!]));
  }

  /** Before any light is computed: the lamps themselves, without shadows and mirrors. */
  private firstLight(scene: SceneReply): Float32Array {
    const k = scene.room.curvature;
    const { positions, normals } = scene.meshes;
    const out = new Float32Array((positions.length / 4) * 3);
    for (let i = 0; i < positions.length / 4; ++i) {
      const p = positions.subarray(4 * i, 4 * i + 4), n = normals.subarray(4 * i, 4 * i + 4);
      for (let c = 0; c < 3; ++c) out[3 * i + c] = scene.light.ambient[c]!;
      for (const lamp of scene.lamps) {
        const c = p[0]! * lamp.at[0]! + k * (p[1]! * lamp.at[1]! + p[2]! * lamp.at[2]!);
        const d = k === 0 ? [0, lamp.at[1]! - p[1]!, lamp.at[2]! - p[2]!] : [0, 1, 2].map((j) => lamp.at[j]! - c * p[j]!);
        const flat = Math.sqrt(Math.max(0, g.inner(k, d, d)));
        const dz = lamp.at[3]! - p[3]!;
        const r = k > 0 ? Math.atan2(flat, c) : k < 0 ? Math.asinh(flat) : flat;
        const f = flat > 1e-9 ? r / flat : 1;
        const square = Math.max(0.01, r * r + dz * dz);
        const cosine = Math.max(0, (f * g.inner(k, d, n) + dz * n[3]!) / Math.sqrt(square));
        const spread = r > 1e-6 ? g.sinK(k, r) / r : 1;
        for (let j = 0; j < 3; ++j) out[3 * i + j]! += (lamp.power[j]! * cosine) / (4 * Math.PI * Math.PI * square * spread);
      }
    }
    return out;
  }

  /** Takes over points of the light job. Makes: whether the picture changes. */
  addLight(reply: LightReply): boolean {
    const { gl, scene } = this;
    if (!scene || reply.all === 0) return false;
    const vertices = scene.meshes.positions.length / 4;
    if (this.lightData.length !== 3 * reply.all) {
      const grown = new Float32Array(3 * reply.all).fill(-1);
      grown.set(this.lightData.subarray(0, 3 * vertices));
      this.lightData = grown;
    }
    this.lightData.set(reply.irradiance, 3 * reply.first);
    if (reply.first < vertices && this.light) {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.light);
      const end = Math.min(vertices, reply.done);
      gl.bufferSubData(gl.ARRAY_BUFFER, 12 * reply.first, this.lightData.subarray(3 * reply.first, 3 * end));
    }
    if (reply.done < reply.all) return reply.first < vertices;
    const grid = (first: number, columns: number, rows: number) => filled(this.lightData.subarray(3 * first, 3 * (first + columns * rows)), columns, rows);
    const floor = this.floatTexture(reply.floor.columns, reply.floor.rows, grid(reply.floor.first, reply.floor.columns, reply.floor.rows));
    const ceiling = this.floatTexture(reply.ceiling.columns, reply.ceiling.rows, grid(reply.ceiling.first, reply.ceiling.columns, reply.ceiling.rows));
    const walls = new Float32Array(32 * 16 * 3 * Math.max(1, reply.walls.length));
    reply.walls.forEach((first, i) => walls.set(grid(first, 32, 16), i * 32 * 16 * 3));
    if (this.lightMaps) for (const map of [this.lightMaps.floor, this.lightMaps.ceiling, this.lightMaps.walls]) gl.deleteTexture(map);
    this.lightMaps = { floor, ceiling, walls: this.floatTexture(32, 16 * Math.max(1, reply.walls.length), walls), reach: reply.floor.reach };
    return true;
  }

  // ---- drawing ------------------------------------------------------------------------------------------------------------------

  draw(shot: Shot): void {
    const { gl, scene, canvas } = this;
    if (!scene) return;
    const width = Math.max(16, Math.round(canvas.width * shot.scale)), height = Math.max(16, Math.round(canvas.height * shot.scale));
    const target = this.targetOf(width, height);
    gl.viewport(0, 0, width, height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.frame);
    gl.drawBuffers(this.key.coded ? [gl.COLOR_ATTACHMENT0, gl.COLOR_ATTACHMENT1] : [gl.COLOR_ATTACHMENT0]);
    gl.disable(gl.DEPTH_TEST);
    const rooms = this.roomProgram();
    gl.useProgram(rooms.program);
    this.setShell(rooms);
    this.setEye(rooms, shot, width, height);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.second);
    gl.enable(gl.DEPTH_TEST);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    this.drawObjects(shot, target.code, width, height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  /** Shows the last picture on the canvas. */
  show(): void {
    const { gl, canvas, target } = this;
    if (!target) return;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, target.frame);
    gl.readBuffer(gl.COLOR_ATTACHMENT0);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
    gl.blitFramebuffer(0, 0, target.width, target.height, 0, 0, canvas.width, canvas.height, gl.COLOR_BUFFER_BIT, target.width === canvas.width ? gl.NEAREST : gl.LINEAR);
  }

  /** Adds the last picture to the mean of those since `restartMean`, and shows the mean. */
  restartMean(): void {
    if (this.sum) this.sum.count = 0;
  }
  showMean(): void {
    const { gl, canvas, target } = this;
    if (!target) return;
    const { width, height } = target;
    if (!this.sum || this.sum.width !== width || this.sum.height !== height) {
      if (this.sum) (gl.deleteTexture(this.sum.texture), gl.deleteFramebuffer(this.sum.frame));
      const texture = gl.createTexture()!;
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA16F, width, height);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
      const frame = gl.createFramebuffer()!;
      gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
      this.sum = { frame, texture, width, height, count: 0 };
    }
    const copy = this.plain('copy', 'uniform sampler2D source; uniform float share; out vec4 c; void main() { c = vec4(texelFetch(source, ivec2(gl_FragCoord.xy), 0).rgb, share); }');
    gl.useProgram(copy.program);
    gl.activeTexture(gl.TEXTURE0);
    gl.uniform1i(copy.at('source'), 0);
    gl.disable(gl.DEPTH_TEST);
    gl.viewport(0, 0, width, height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.sum.frame);
    gl.bindTexture(gl.TEXTURE_2D, target.color);
    gl.uniform1f(copy.at('share'), 1 / ++this.sum.count);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.disable(gl.BLEND);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.bindTexture(gl.TEXTURE_2D, this.sum.texture);
    gl.uniform1f(copy.at('share'), 1);
    if (width === canvas.width) gl.drawArrays(gl.TRIANGLES, 0, 3);
    else this.show();
  }

  /** The pixels of the canvas, rows from top to bottom. */
  read(): Uint8Array {
    const { gl, canvas } = this;
    const { width, height } = canvas;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    const up = new Uint8Array(width * height * 4), down = new Uint8Array(width * height * 4);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, up);
    for (let y = 0; y < height; ++y) down.set(up.subarray(4 * width * y, 4 * width * (y + 1)), 4 * width * (height - 1 - y));
    return down;
  }

  private setEye(p: Program, shot: Shot, width: number, height: number): void {
    const { gl, canvas } = this;
    const m = shot.eye.roomFromEye, a = axes(shot.eye);
    gl.uniformMatrix3fv(p.at('eye_frame'), false, [...g.column(m, 0), ...g.column(m, 1), ...g.column(m, 2)]);
    gl.uniform1f(p.at('eye_z'), shot.eye.z);
    gl.uniform3fv(p.at('forward'), a.forward);
    gl.uniform3fv(p.at('right'), a.right);
    gl.uniform3fv(p.at('up_vector'), a.up);
    const t = Math.tan(shot.fov / 2);
    gl.uniform2f(p.at('half_size'), t, (t * canvas.height) / canvas.width);
    const [jx, jy] = shot.jitter ?? [0, 0];
    gl.uniform4f(p.at('view'), 2 / width, 2 / height, shot.shift[0] + (2 * jx) / width, shot.shift[1] + (2 * jy) / height);
  }

  private setShell(p: Program): void {
    const { gl, key } = this;
    const scene = this.scene!;
    const { room, shell } = scene;
    const flat = (list: number[][]) => new Float32Array(list.flat());
    gl.uniform3fv(p.at('wall_line'), flat(room.walls.map((w) => w.line)));
    gl.uniform3fv(p.at('wall_start'), flat(room.walls.map((w) => w.start)));
    gl.uniform3fv(p.at('wall_along'), flat(room.walls.map((w) => w.along)));
    gl.uniform1fv(p.at('wall_length'), new Float32Array(room.walls.map((w) => w.length)));
    const areas: number[][] = [], shares: number[][] = [];
    shell.walls.forEach((wall, i) => {
      for (let m = 0; m < key.mirrorsPerWall; ++m) {
        const mirror = wall.mirrors[m];
        // Ends at the ends of the wall lie at infinity: no ray slips through a corner.
        const end = (x: number, limit: number, far: number) => (Math.abs(x - limit) < 1e-9 ? far : x);
        areas.push(
          mirror ? [end(mirror.span[0]!, 0, -1e9), end(mirror.span[1]!, room.walls[i]!.length, 1e9), end(mirror.height[0]!, 0, -1e9), end(mirror.height[1]!, room.height, 1e9)] : [0, 0, 0, 0],
        );
        shares.push(mirror ? mirror.throughput : [-1, -1, -1]);
      }
    });
    gl.uniform4fv(p.at('mirror_area'), flat(areas));
    gl.uniform3fv(p.at('mirror_share'), flat(shares));
    const surfaces = [...shell.walls, shell.floor, shell.ceiling];
    const emission = (s: Material) => (s.kind === 'emissive' ? s.emission : 1);
    gl.uniform4fv(p.at('surface_color'), flat(surfaces.map((s) => [...s.color.map((c) => c * emission(s)), s.pattern === 'texture' && s.texture < 0 ? 0 : patterns.indexOf(s.pattern)])));
    gl.uniform4fv(p.at('surface_second'), flat(surfaces.map((s) => [...s.second.map((c) => c * emission(s)), s.cell])));
    const horizontal = [shell.floor, shell.ceiling].map((s) => (s.mirrors[0] ? [...s.mirrors[0].throughput, 1] : [0, 0, 0, 0]));
    gl.uniform4fv(p.at('horizontal_mirror'), flat(horizontal));
    gl.uniform1f(p.at('height'), room.height);
    const { exposure } = scene.light;
    gl.uniform1f(p.at('exposure'), exposure);
    gl.uniform3fv(p.at('background'), this.background().map((x) => x / (exposure || 1)));
    gl.uniform1i(p.at('bounces'), scene.cover.max_bounces);
    gl.uniform1f(p.at('min_weight'), scene.cover.min_weight);
    const lit = this.lightMaps !== null && scene.light.lit;
    gl.uniform1i(p.at('lit'), lit ? 1 : 0);
    const maps = [this.lightMaps?.floor, this.lightMaps?.ceiling, this.lightMaps?.walls];
    ['floor_light', 'ceiling_light', 'wall_light'].forEach((name, i) => {
      gl.activeTexture(gl.TEXTURE1 + i);
      gl.bindTexture(gl.TEXTURE_2D, maps[i] ?? this.white);
      gl.uniform1i(p.at(name), 1 + i);
    });
    gl.uniform1f(p.at('light_reach'), this.lightMaps?.reach ?? 1);
    const textured = surfaces.find((s) => s.pattern === 'texture' && s.texture >= 0);
    gl.activeTexture(gl.TEXTURE4);
    gl.bindTexture(gl.TEXTURE_2D, textured ? this.textures[textured.texture]! : this.white);
    gl.uniform1i(p.at('shell_texture'), 4);
  }

  /** The color where mirrors are followed no further. */
  private background(): number[] {
    const { cover, shell, light } = this.scene!;
    if (!cover.expected) return cover.background;
    // What is expected there: the mean of floor and ceiling, in about the light of the room.
    const mean = (m: Material) => m.color.map((c, i) => (m.pattern === 'plain' ? c : (c + m.second[i]!) / 2));
    const a = mean(shell.floor), b = mean(shell.ceiling);
    let level = [1, 1, 1];
    if (light.lit) {
      const data = this.lightData;
      const sum = [0, 0, 0];
      let count = 0;
      for (let i = 0; i + 2 < data.length; i += 3 * 7)
        if (data[i]! >= 0) (sum[0]! += data[i]!), (sum[1]! += data[i + 1]!), (sum[2]! += data[i + 2]!), ++count;
      level = sum.map((x) => (light.exposure * x) / Math.max(1, count));
    } else level = [light.exposure, light.exposure, light.exposure];
    return a.map((x, c) => ((x + b[c]!) / 2) * level[c]!);
  }

  private drawObjects(shot: Shot, code: WebGLTexture, width: number, height: number): void {
    const { gl, key } = this;
    const scene = this.scene!;
    if (this.meshes.length === 0) return;
    const k = scene.room.curvature;
    const copies = this.kinds.coded ? beams(scene, shot.eye.roomFromEye, scene.cover.max_bounces, 1500) : this.group;
    const eyeFromRoom = g.inverse(k, shot.eye.roomFromEye);
    const pixels = width / 2 / Math.tan(shot.fov / 2);
    const maps = copies.map((copy) => g.multiply(eyeFromRoom, copy.coverFromRoom));
    const lists = this.meshes.map((mesh) => this.seenImages(mesh, copies, maps, shot, pixels));
    const total = lists.reduce((n, list) => n + list.length, 0);
    const rows = new Float32Array(Math.max(1, total) * floatsPerInstance), words = new Uint32Array(Math.max(1, total) * 4);
    let next = 0;
    for (const list of lists)
      for (const { index } of list) {
        const copy = copies[index]!;
        rows.set(maps[index]!, next * floatsPerInstance);
        rows.set(copy.weight, next * floatsPerInstance + 9);
        rows[next * floatsPerInstance + 12] = copy.sheet + 8 * copy.met;
        if (key.coded) words.set(codeOf(copy.word), 4 * next);
        ++next;
      }
    gl.bindBuffer(gl.ARRAY_BUFFER, this.instances);
    gl.bufferData(gl.ARRAY_BUFFER, rows, gl.STREAM_DRAW);
    if (key.coded) {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.words);
      gl.bufferData(gl.ARRAY_BUFFER, words, gl.STREAM_DRAW);
    }
    this.prepared.clear();
    this.counts = { copies: total, triangles: 0 };
    let first = 0;
    this.meshes.forEach((mesh, i) => {
      const p = this.objectProgram(this.lookOf(mesh.part));
      gl.useProgram(p.program);
      this.prepare(p, shot, code, width, height);
      this.drawMesh(p, mesh, shot, { first, distances: lists[i]!.map((image) => image.distance) }, pixels);
      first += lists[i]!.length;
    });
    gl.bindVertexArray(null);
  }

  private lookOf(part: MeshPart): Look {
    const scene = this.scene!;
    const style = part.style >= 0 ? scene.styles[part.style]! : null;
    const pattern = !style ? 0 : style.texture >= 0 ? 5 : ['marble', 'wood', 'granite'].includes(style.pattern) ? patterns.indexOf(style.pattern) : 0;
    const shine = style?.kind === 'metal' && scene.light.lit ? 1 : style?.kind === 'mirror' ? 2 : style?.kind === 'glass' ? 3 : 0;
    return { pattern, shine, inRoom: part.part < 0 };
  }

  /** What a program of objects needs to know once a picture. */
  private prepare(p: Program, shot: Shot, code: WebGLTexture, width: number, height: number): void {
    const { gl } = this;
    if (this.prepared.has(p)) return;
    this.prepared.add(p);
    this.setShell(p);
    if (this.scene!.light.lit) gl.uniform1i(p.at('lit'), 1);
    this.setEye(p, shot, width, height);
    gl.activeTexture(gl.TEXTURE5);
    gl.bindTexture(gl.TEXTURE_2D, code);
    gl.uniform1i(p.at('path_code'), 5);
  }

  private drawMesh(p: Program, mesh: Mesh, shot: Shot, images: { first: number; distances: number[] }, pixels: number): void {
    const { distances } = images;
    const { gl } = this;
    const scene = this.scene!;
    const style = mesh.part.style >= 0 ? scene.styles[mesh.part.style]! : null;
    gl.uniform1f(p.at('style_emission'), style?.kind === 'emissive' ? style.emission : 0);
    if (style) {
      gl.uniform3fv(p.at('style_first'), style.color);
      gl.uniform3fv(p.at('style_second'), style.second);
      gl.uniform1f(p.at('style_cell'), style.cell);
      gl.uniform1f(p.at('style_cutoff'), style.cutoff);
      gl.uniform1f(p.at('style_index'), style.index);
    }
    gl.activeTexture(gl.TEXTURE6);
    gl.bindTexture(gl.TEXTURE_2D, style && style.texture >= 0 ? this.textures[style.texture]! : this.white);
    gl.uniform1i(p.at('picture'), 6);
    const moved = shot.moved && shot.moved.part === mesh.part.part ? shot.moved : null;
    const m = moved?.map ?? g.identity();
    gl.uniformMatrix3fv(p.at('moved'), false, [...g.column(m, 0), ...g.column(m, 1), ...g.column(m, 2)]);
    gl.uniform1f(p.at('lifted'), moved?.lifted ?? 0);
    const glow = shot.selected !== undefined && shot.selected === mesh.part.part ? 0.02 : 0;
    gl.uniform3f(p.at('glow'), glow, glow * 1.6, glow * 2.6);
    gl.bindVertexArray(mesh.vao);
    // The copies stand by distance: the first are drawn in all detail, the next from coarser levels, as far as the error stays small.
    const allowed = errorPixels[shot.detail] / pixels;
    let first = 0;
    while (first < distances.length) {
      const levelAt = (i: number) => {
        let level = 0;
        while (level + 1 < mesh.levels.length && mesh.levels[level + 1]!.error <= allowed * distances[i]!) ++level;
        return level;
      };
      const level = levelAt(first);
      let end = first + 1;
      while (end < distances.length && (level === mesh.levels.length - 1 || levelAt(end) === level)) ++end;
      const { first: begin, count } = mesh.levels[level]!;
      if (count > 0) {
        this.pointAtInstance(images.first + first);
        gl.drawElementsInstanced(gl.TRIANGLES, count, gl.UNSIGNED_INT, 4 * begin, end - first);
        this.counts.triangles += (count / 3) * (end - first);
      }
      first = end;
    }
  }

  /** The images of a part that may be in the picture and are larger than a pixel, nearest first. The distance is that of its ball. */
  private seenImages(mesh: Mesh, copies: Copy[], maps: g.Matrix[], shot: Shot, pixels: number): { index: number; distance: number }[] {
    const scene = this.scene!;
    const k = scene.room.curvature, a = axes(shot.eye);
    const edge = Math.atan(Math.tan(shot.fov / 2) * (1 + Math.abs(shot.shift[0])) * Math.hypot(1, this.canvas.height / this.canvas.width)) + 0.05;
    const list: { index: number; distance: number }[] = [];
    copies.forEach((copy, index) => {
      const m = maps[index]!, at = mesh.centre;
      const [x, y] = g.logMap(k, g.apply(m, at));
      const z = at[3]! - shot.eye.z;
      let flat = Math.hypot(x, y), side = 1;
      if (copy.sheet > 0) {
        if (copy.sheet % 2 === 0) flat += copy.sheet * Math.PI;
        else (flat = (copy.sheet + 1) * Math.PI - flat), (side = -1);
      }
      const distance = Math.hypot(flat, z);
      // On S² an image grows towards the antipode: it is drawn, whatever its place.
      const growth = k > 0 ? flat / Math.max(0.05, Math.abs(Math.sin(flat))) : 1;
      const radius = mesh.radius * growth;
      if (distance > radius * 1.05) {
        const scale = flat > 1e-9 ? (side * flat) / Math.hypot(x, y) : 1;
        const ahead = (scale * x * a.forward[0] + scale * y * a.forward[1] + z * a.forward[2]) / distance;
        if (Math.acos(Math.min(1, Math.max(-1, ahead))) > edge + Math.asin(Math.min(1, radius / distance))) return;
        if ((radius / distance) * pixels < (shot.detail === 'moving' ? 1.4 : 0.7)) return;
      }
      list.push({ index, distance: Math.max(0.03, distance - radius) / growth });
    });
    return list.sort((p, q) => p.distance - q.distance).slice(0, 2500);
  }

  // ---- WebGL's things ------------------------------------------------------------------------------------------------------------

  private mesh(part: MeshPart, buffers: WebGLBuffer[]): Mesh {
    const { gl } = this;
    const vao = gl.createVertexArray()!;
    gl.bindVertexArray(vao);
    [4, 4, 3, 3, 3].forEach((size, i) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, buffers[i]!);
      gl.enableVertexAttribArray(i);
      gl.vertexAttribPointer(i, size, gl.FLOAT, false, 0, 0);
    });
    this.pointAtInstance(0);
    const levels = levelsOf(this.scene!, part);
    const index = gl.createBuffer()!;
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, index);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, levels.indices, gl.STATIC_DRAW);
    this.buffers.push(index);
    gl.bindVertexArray(null);
    return { part, vao, levels: levels.levels, ...ballOf(this.scene!, part) };
  }

  /** The instances that the next call draws begin with this one: WebGL2 has no base instance. */
  private pointAtInstance(first: number): void {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.instances);
    [3, 3, 3, 4].forEach((size, i) => {
      gl.enableVertexAttribArray(5 + i);
      gl.vertexAttribPointer(5 + i, size, gl.FLOAT, false, 4 * floatsPerInstance, 4 * floatsPerInstance * first + 12 * i);
      gl.vertexAttribDivisor(5 + i, 1);
    });
    if (!this.key.coded) return;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.words);
    gl.enableVertexAttribArray(9);
    gl.vertexAttribIPointer(9, 4, gl.UNSIGNED_INT, 0, 16 * first);
    gl.vertexAttribDivisor(9, 1);
  }

  private buffer(data: Float32Array, usage: number): WebGLBuffer {
    const { gl } = this;
    const made = gl.createBuffer()!;
    gl.bindBuffer(gl.ARRAY_BUFFER, made);
    gl.bufferData(gl.ARRAY_BUFFER, data, usage);
    return made;
  }

  private texture(width: number, height: number, pixels: Uint8Array, repeat = false): WebGLTexture {
    const { gl } = this;
    const made = gl.createTexture()!;
    gl.bindTexture(gl.TEXTURE_2D, made);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.SRGB8_ALPHA8, width, height, 0, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, repeat ? gl.REPEAT : gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, repeat ? gl.REPEAT : gl.CLAMP_TO_EDGE);
    gl.generateMipmap(gl.TEXTURE_2D);
    return made;
  }

  private floatTexture(width: number, height: number, data: Float32Array): WebGLTexture {
    const { gl } = this;
    const made = gl.createTexture()!;
    gl.bindTexture(gl.TEXTURE_2D, made);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB16F, width, height, 0, gl.RGB, gl.FLOAT, data);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.LINEAR);
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
    return made;
  }

  private targetOf(width: number, height: number): NonNullable<RoomView['target']> {
    const { gl } = this;
    if (this.target?.width === width && this.target.height === height) return this.target;
    if (this.target) {
      for (const frame of [this.target.frame, this.target.second]) gl.deleteFramebuffer(frame);
      for (const texture of [this.target.color, this.target.code]) gl.deleteTexture(texture);
      gl.deleteRenderbuffer(this.target.depth);
    }
    const storage = (format: number) => {
      const texture = gl.createTexture()!;
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
      return texture;
    };
    const color = storage(gl.RGBA8), code = storage(gl.RG32UI);
    const depth = gl.createRenderbuffer()!;
    gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, width, height);
    // A texture may not be read while it is attached: so there are two frames that share color.
    const frame = gl.createFramebuffer()!, second = gl.createFramebuffer()!;
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, color, 0);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT1, gl.TEXTURE_2D, code, 0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, second);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, color, 0);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
    return (this.target = { frame, second, color, code, depth, width, height });
  }

  private roomProgram(): Program {
    const name = nameOf(this.key);
    return this.programs.get(name) ?? this.link(name, ...roomSources(this.key));
  }
  private objectProgram(look: Look): Program {
    const name = nameOf(this.key, look);
    return this.programs.get(name) ?? this.link(name, ...objectSources(this.key, look));
  }
  private plain(name: string, fragment: string): Program {
    const vertex = '#version 300 es\nvoid main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }';
    return this.programs.get(name) ?? this.link(name, vertex, '#version 300 es\nprecision highp float;\n' + fragment);
  }
  private link(name: string, vertex: string, fragment: string): Program {
    const { gl } = this;
    const program = gl.createProgram()!;
    ++this.built;
    for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]] as const) {
      const shader = gl.createShader(type)!;
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
      const logs = gl.getAttachedShaders(program)!.map((s) => gl.getShaderInfoLog(s)).join('\n');
      throw new Error(`the shader ${name} failed: ${logs}\n${gl.getProgramInfoLog(program)}`);
    }
    const places = new Map<string, WebGLUniformLocation | null>();
    const at = (uniform: string) => {
      if (!places.has(uniform)) places.set(uniform, gl.getUniformLocation(program, uniform));
      return places.get(uniform)!;
    };
    const made = { program, at };
    this.programs.set(name, made);
    return made;
  }
}

/** Points that were not computed (-1) take the mean of their neighbours, ring by ring, so that interpolation at the room's border is right. */
function filled(data: Float32Array, columns: number, rows: number): Float32Array {
  const out = new Float32Array(data);
  for (let round = 0; round < 3; ++round) {
    const before = new Float32Array(out);
    for (let y = 0; y < rows; ++y)
      for (let x = 0; x < columns; ++x) {
        const at = 3 * (y * columns + x);
        if (before[at]! >= 0) continue;
        const sum = [0, 0, 0];
        let count = 0;
        for (let dy = -1; dy <= 1; ++dy)
          for (let dx = -1; dx <= 1; ++dx) {
            const near = 3 * ((y + dy) * columns + x + dx);
            if (x + dx < 0 || x + dx >= columns || y + dy < 0 || y + dy >= rows || before[near]! < 0) continue;
            for (let c = 0; c < 3; ++c) sum[c]! += before[near + c]!;
            ++count;
          }
        if (count > 0) for (let c = 0; c < 3; ++c) out[at + c] = sum[c]! / count;
      }
  }
  return out.map((x) => Math.max(0, x));
}

function ballOf(scene: SceneReply, part: MeshPart): { centre: number[]; radius: number } {
  const k = scene.room.curvature, { positions } = scene.meshes;
  const sum = [0, 0, 0, 0];
  for (const v of part.indices) for (let c = 0; c < 4; ++c) sum[c]! += positions[4 * v + c]!;
  const mean = sum.map((x) => x / Math.max(1, part.indices.length));
  const size = k === 0 ? 1 : Math.sqrt(Math.max(1e-9, mean[0]! ** 2 + k * (mean[1]! ** 2 + mean[2]! ** 2)));
  const centre = [k === 0 ? 1 : mean[0]! / size, mean[1]! / size, mean[2]! / size, mean[3]!];
  const [x, y] = g.logMap(k, centre);
  const back = g.translation(k, -x, -y);
  let radius = 0;
  for (const v of part.indices) {
    const [a, b] = g.logMap(k, g.apply(back, positions.subarray(4 * v, 4 * v + 3)));
    radius = Math.max(radius, Math.hypot(a, b, positions[4 * v + 3]! - centre[3]!));
  }
  return { centre, radius };
}

/** Levels of detail of a part by clustering of vertices: of all vertices in a cell of a grid the first one stands for them. All levels share
 *  the vertices. Source: Rossignac, Borrel, Multi-resolution 3D approximations for rendering complex scenes (1993). */
function levelsOf(scene: SceneReply, part: MeshPart): { indices: Uint32Array; levels: { first: number; count: number; error: number }[] } {
  const k = scene.room.curvature, { positions } = scene.meshes;
  const lists: Uint32Array[] = [part.indices];
  const levels = [{ first: 0, count: part.indices.length, error: 0 }];
  if (part.indices.length > 3 * 200) {
    const at = (v: number): [number, number, number] => {
      const w = positions[4 * v]!, f = k === 0 ? 1 : 2 / (1 + w);
      return [f * positions[4 * v + 1]!, f * positions[4 * v + 2]!, positions[4 * v + 3]!];
    };
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (const v of part.indices) at(v).forEach((x, c) => ((low[c] = Math.min(low[c]!, x)), (high[c] = Math.max(high[c]!, x))));
    const extent = Math.max(...high.map((x, c) => x - low[c]!), 1e-6);
    for (const cells of [96, 64, 48, 32, 24, 16, 12, 8, 6, 4]) {
      const size = extent / cells;
      const owner = new Map<number, number>(), representative = new Map<number, number>();
      const kept: number[] = [];
      const find = (v: number): number => {
        const known = representative.get(v);
        if (known !== undefined) return known;
        const [x, y, z] = at(v).map((q, c) => Math.floor((q - low[c]!) / size)) as [number, number, number];
        const cell = (x * 128 + y) * 128 + z;
        if (!owner.has(cell)) owner.set(cell, v);
        representative.set(v, owner.get(cell)!);
        return owner.get(cell)!;
      };
      for (let i = 0; i < part.indices.length; i += 3) {
        const a = find(part.indices[i]!), b = find(part.indices[i + 1]!), c = find(part.indices[i + 2]!);
        if (a !== b && b !== c && c !== a) kept.push(a, b, c);
      }
      const last = levels[levels.length - 1]!;
      if (kept.length > 0.75 * last.count || kept.length === 0) continue;
      levels.push({ first: last.first + last.count, count: kept.length, error: 0.6 * size });
      lists.push(new Uint32Array(kept));
    }
  }
  const indices = new Uint32Array(levels.reduce((n, level) => n + level.count, 0));
  lists.forEach((list, i) => indices.set(list, levels[i]!.first));
  return { indices, levels };
}
