import type { ExportReply, MeshReply } from '../state/reply';

/** The core as typed functions. Its glue, createCore, is a script of its own (scripts/web). */
interface Module {
  HEAPU8: Uint8Array;
  HEAPU32: Uint32Array;
  _malloc(size: number): number;
  _free(at: number): void;
  [name: string]: unknown;
}
declare const createCore: (options: object) => Promise<Module>;

const kinds = { f32: Float32Array, f64: Float64Array, u32: Uint32Array, u8: Uint8Array } as const;

export class Core {
  private constructor(private readonly module: Module) {}

  static async start(wasm: ArrayBuffer, told?: (stage: string, done: number, all: number) => void): Promise<Core> {
    const module = await createCore({
      told,
      instantiateWasm(imports: WebAssembly.Imports, ready: (i: WebAssembly.Instance, m: WebAssembly.Module) => void) {
        void WebAssembly.instantiate(wasm, imports).then((made) => ready(made.instance, made.module));
        return {};
      },
    });
    return new Core(module);
  }

  asset(name: string, bytes: Uint8Array): void {
    const encoded = new TextEncoder().encode(name);
    const at = this.copyIn(encoded), data = this.copyIn(bytes);
    this.call('_orbc_asset', at, encoded.length, data, bytes.length);
    this.module._free(at);
    this.module._free(data);
  }
  takeMesh(name: string, bytes: Uint8Array): MeshReply {
    const encoded = new TextEncoder().encode(name);
    const at = this.copyIn(encoded), data = this.copyIn(bytes);
    const reply = this.reply<MeshReply>(this.call('_orbc_take_mesh', at, encoded.length, data, bytes.length));
    this.module._free(at);
    this.module._free(data);
    return reply;
  }
  open<T>(text: string): T {
    return this.withText<T>('_orbc_open', text);
  }
  notation<T>(text: string, real: boolean): T {
    return this.withText<T>('_orbc_notation', text, real ? 1 : 0);
  }
  copies<T>(bounces: number, most: number): T {
    return this.reply<T>(this.call('_orbc_copies', bounces, most));
  }
  light<T>(count: number): T {
    return this.reply<T>(this.call('_orbc_light', count));
  }
  traceBegin(eye: number[], fov: number, width: number, height: number, shift: number[]): void {
    const at = this.copyIn(new Uint8Array(new Float64Array([...eye, ...shift]).buffer));
    this.call('_orbc_trace_begin', at, fov, width, height, at + 8 * eye.length);
    this.module._free(at);
  }
  traceTile(x: number, y: number, width: number, height: number, index: number, samples: number): Uint8Array {
    const at = this.copyIn(new Uint8Array(new Int32Array([x, y, width, height]).buffer));
    const reply = this.reply<{ pixels: Uint8Array }>(this.call('_orbc_trace_tile', at, index, samples));
    this.module._free(at);
    return reply.pixels;
  }

  /** In: `eye` as for traceBegin; null: where the scene's camera stands. */
  export(text: string, format: string, eye: number[] | null): ExportReply {
    const name = this.copyIn(new TextEncoder().encode(format + '\0'));
    const at = eye ? this.copyIn(new Uint8Array(new Float64Array(eye).buffer)) : 0;
    const reply = this.withText<ExportReply>('_orbc_export', text, name, at);
    if (at) this.module._free(at);
    this.module._free(name);
    return reply;
  }

  private call(name: string, ...values: number[]): number {
    return (this.module[name] as (...values: number[]) => number)(...values);
  }
  private copyIn(bytes: Uint8Array): number {
    const at = this.module._malloc(Math.max(8, bytes.length));
    this.module.HEAPU8.set(bytes, at);
    return at;
  }
  private withText<T>(name: string, text: string, ...more: number[]): T {
    const bytes = new TextEncoder().encode(text);
    const at = this.copyIn(bytes);
    const reply = this.reply<T>(this.call(name, at, bytes.length, ...more));
    this.module._free(at);
    return reply;
  }
  /** Copies a reply out of the core's memory, which may move at any later call. */
  private reply<T>(at: number): T {
    const [json, jsonSize, block, blockSize] = this.module.HEAPU32.subarray(at >> 2, (at >> 2) + 4) as unknown as number[];
    const text = new TextDecoder().decode(this.module.HEAPU8.slice(json, json! + jsonSize!));
    const bytes = this.module.HEAPU8.slice(block, block! + blockSize!).buffer;
    const made = JSON.parse(text, (_, value: unknown) => {
      const array = value as { type?: keyof typeof kinds; at?: number; count?: number } | null;
      if (!array || typeof array !== 'object' || array.at === undefined || array.count === undefined || !array.type) return value;
      return new kinds[array.type](bytes, array.at, array.count);
    }) as T & { failure?: string };
    if (made.failure) throw new Error(made.failure);
    return made;
  }
}
