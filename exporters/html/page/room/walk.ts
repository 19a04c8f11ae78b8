/** What the eye's keys, pointer and touch do, and the loop that draws. Pointer events only; a drag begins at 6 pixels. */
import { effect } from '@preact/signals';
import * as app from '../state/app';
import { Truth } from '../truth/truth';
import { moveObject } from '../ui/move';
import { eyeOfScene, lift, step, type Eye } from './eye';
import * as g from './geometry';
import { lens, rayAt } from './lens';
import { pick, pointAtHeight } from './pick';
import type { RoomView, Shot } from './view';

export function holonomy(home: Eye, eye: Eye): { angle: number; mirrored: number } {
  // The frame carried along the walk against the one that the straight way home carries.
  const m = eye.roomFromEye, h = home.roomFromEye;
  const k = app.scene.value?.room.curvature ?? 0;
  const relative = g.multiply(g.inverse(k, h), m);
  const [x, y] = g.logMap(k, g.column(relative, 0));
  const straight = g.multiply(g.translation(k, -x, -y), relative);
  const flipped = g.determinant(straight) < 0;
  return { angle: (-Math.atan2(straight[7]!, straight[4]!) * 180) / Math.PI, mirrored: flipped || eye.mirrored ? Math.max(eye.mirrored, 1) : 0 };
}

const scales = [1, 0.71, 0.5, 0.36, 0.25];
const dragPixels = 6;

export class Walk {
  private keys = new Set<string>();
  private last = 0;
  private level = 1;
  private slow = 0;
  private fast = 0;
  private dirty = true;
  private newLight = false;
  private lastLive = 0;
  private restSince = 0;
  private smoothed = 0;
  private pointers = new Map<number, { x: number; y: number; startX: number; startY: number; role: 'look' | 'walk' | 'thing'; moved: boolean; object: number }>();
  readonly truth: Truth;
  /** Turned on by tests: one picture at pixel centres, at full size. */
  exact = false;
  frames: number[] = [];

  constructor(private view: RoomView, private canvas: HTMLCanvasElement) {
    this.truth = new Truth(view);
    if (view.isSoftware) this.level = 2;
    addEventListener('keydown', (e) => this.key(e));
    addEventListener('keyup', (e) => this.keys.delete(e.code));
    addEventListener('blur', () => this.keys.clear());
    canvas.addEventListener('pointerdown', (e) => this.down(e));
    canvas.addEventListener('pointermove', (e) => this.move(e));
    canvas.addEventListener('pointerup', (e) => this.up(e));
    canvas.addEventListener('pointercancel', (e) => this.up(e));
    canvas.addEventListener('wheel', (e) => (e.preventDefault(), this.go(-e.deltaY * 0.0012, 0)), { passive: false });
    addEventListener('resize', () => this.resize());
    app.listen((m) => {
      if (m.kind === 'light' && view.addLight(m.light)) this.newLight = true;
      if (m.kind === 'opened') this.touch();
      if (m.kind === 'tile') this.truth.tile(m);
    });
    effect(() => {
      void app.eye.value;
      void app.mode.value;
      void app.tab.value;
      void app.selection.value;
      void app.difference.value;
      this.touch();
    });
    this.resize();
    requestAnimationFrame((t) => this.frame(t));
  }

  touch(): void {
    this.dirty = true;
    this.smoothed = 0;
    this.restSince = performance.now();
    this.truth.stop();
  }

  private resize(): void {
    const ratio = Math.min(2, devicePixelRatio || 1);
    this.canvas.width = Math.round(innerWidth * ratio);
    this.canvas.height = Math.round(innerHeight * ratio);
    this.touch();
  }

  // ---- keys ----------------------------------------------------------------------------------------------------------------------

  private key(e: KeyboardEvent): void {
    const target = e.target as HTMLElement;
    if ((e.ctrlKey || e.metaKey) && !target.closest('.cm-editor')) {
      if (e.key.toLowerCase() === 'z') (e.preventDefault(), e.shiftKey ? app.document_.redo() : app.document_.undo());
      if (e.key.toLowerCase() === 'y') (e.preventDefault(), app.document_.redo());
      return;
    }
    if (e.ctrlKey || e.metaKey || e.altKey) return;
    if (target.closest('input, textarea, select, .cm-editor')) {
      if (e.key === 'Escape') (target as HTMLElement).blur();
      return;
    }
    if (e.key === 'Escape') return this.escape();
    if (app.empty.value) {
      const card = document.querySelectorAll<HTMLElement>('.card')[Number(e.key) - 1];
      if (/^[1-9]$/.test(e.key)) card?.click();
      return;
    }
    if (target.closest('button, [role=spinbutton], [role=menuitem], [role=tab]') && (e.key === 'Enter' || e.key === ' ')) return;
    const single: Record<string, () => void> = {
      Enter: () => (app.mode.value = app.mode.value === 'walk' ? 'design' : 'walk'),
      '?': () => (app.menu.value = 'keys'),
      x: () => (app.difference.value = !app.difference.value),
      t: () => (app.throughMirrors.value = !app.throughMirrors.value),
      p: () => (app.projector.value = !app.projector.value),
      h: () => app.scene.value && (app.eye.value = eyeOfScene(app.scene.value)),
      Delete: () => this.removeChosen(),
      Backspace: () => this.removeChosen(),
    };
    const act = single[e.key.length === 1 ? e.key.toLowerCase() : e.key];
    if (act && !e.repeat) {
      act();
      e.preventDefault();
      return;
    }
    if (/^(Key[WASDQERF]|Arrow(Up|Down|Left|Right)|ShiftLeft|ShiftRight)$/.test(e.code)) {
      if (e.code.startsWith('Arrow') && target.closest('[role=spinbutton], [role=tablist], [role=menu]')) return;
      this.keys.add(e.code);
      e.preventDefault();
    }
  }

  private escape(): void {
    if (this.pointers.size > 0 && app.dragging.value) {
      app.cancelDrag();
      this.pointers.clear();
    } else if (app.menu.value) app.menu.value = null;
    else if (app.corner.value !== null) app.corner.value = null;
    else app.mode.value = 'walk';
  }

  private removeChosen(): void {
    const chosen = app.selection.value;
    if (app.mode.value !== 'design' || (chosen.kind !== 'object' && chosen.kind !== 'lamp')) return;
    app.take(chosen.kind === 'object' ? app.objectPath(chosen.index) : app.lampPath(chosen.index));
    app.selection.value = { kind: 'room' };
  }

  // ---- pointer and touch -------------------------------------------------------------------------------------------------------------

  private ray(e: { clientX: number; clientY: number }): g.Vector {
    return rayAt(lens(), e.clientX, e.clientY);
  }

  /** The object, not its image, that stands under a point of the screen, or -1. */
  objectAt(clientX: number, clientY: number): number {
    if (!app.scene.value || !app.eye.value) return -1;
    const found = pick(app.scene.value, app.eye.value, this.ray({ clientX, clientY }));
    return found.word.length === 0 ? found.object : -1;
  }

  private down(e: PointerEvent): void {
    this.canvas.focus();
    app.menu.value = null;
    this.canvas.setPointerCapture(e.pointerId);
    const left = e.pointerType === 'touch' && app.mode.value === 'walk' && e.clientX < innerWidth / 2;
    const object = app.mode.value === 'design' ? this.objectAt(e.clientX, e.clientY) : -1;
    this.pointers.set(e.pointerId, { x: e.clientX, y: e.clientY, startX: e.clientX, startY: e.clientY, role: left ? 'walk' : object >= 0 ? 'thing' : 'look', moved: false, object });
  }

  private move(e: PointerEvent): void {
    const p = this.pointers.get(e.pointerId);
    if (!p) return this.hover(e);
    const dx = e.clientX - p.x, dy = e.clientY - p.y;
    if (!p.moved && Math.hypot(e.clientX - p.startX, e.clientY - p.startY) < dragPixels) return;
    p.moved = true;
    p.x = e.clientX;
    p.y = e.clientY;
    const eye = app.eye.value;
    if (!eye) return;
    if (p.role === 'walk') return;
    if (p.role === 'thing') return this.dragThing(e, p.object);
    const rate = this.shot().fov / innerWidth;
    app.eye.value = { ...eye, yaw: eye.yaw + dx * rate * this.handed(eye), pitch: Math.min(1.5, Math.max(-1.5, eye.pitch + dy * rate)) };
    app.stepped.value = true;
  }
  /** Looking does not depend on the room having flipped: the eye's own frame is right-handed always. */
  private handed(_: Eye): number {
    return 1;
  }

  private dragThing(e: PointerEvent, object: number): void {
    const s = app.scene.value!, eye = app.eye.value!;
    const at = pointAtHeight(s, eye, this.ray(e), s.objects[object]!.at[3]!);
    if (!at) return;
    moveObject(object, at, e.altKey);
    app.selection.value = { kind: 'object', index: object };
    const there = app.draggedTo.value ?? at;
    const [x, y] = g.logMap(s.room.curvature, there);
    const blocked = app.stale.value;
    const place = `${Math.hypot(x, y).toPrecision(3)} from the centre, ${Math.round((Math.atan2(y, x) * 180) / Math.PI + 360) % 360}°`;
    app.tag.value = {
      x: e.clientX + 16,
      y: e.clientY + (e.pointerType === 'touch' ? -48 : 16),
      title: s.objects[object]!.name,
      more: blocked ? (app.errors.value[0]?.message ?? '') : app.snapped.value ? `${place}, ${app.snapped.value.words}` : place,
      blocked,
    };
  }

  private hover(e: PointerEvent): void {
    if (app.mode.value !== 'design' || !app.scene.value || !app.eye.value || e.pointerType === 'touch') {
      if (app.tag.value) app.tag.value = null;
      return;
    }
    const found = pick(app.scene.value, app.eye.value, this.ray(e));
    const words = found.word.map((w) => w + 1).join(' ');
    this.canvas.style.cursor = found.object >= 0 ? (found.word.length ? 'pointer' : 'move') : found.wall >= 0 ? 'pointer' : 'grab';
    if (found.object < 0) return void (app.tag.value = null);
    app.tag.value = {
      x: e.clientX + 16,
      y: e.clientY + 16,
      title: `${app.scene.value.objects[found.object]!.name}${words ? ` in wall ${words}` : ''}`,
      more: `${found.word.length % 2 ? 'mirrored · ' : ''}${found.distance.toFixed(2)} away`,
      blocked: false,
    };
  }

  private up(e: PointerEvent): void {
    const p = this.pointers.get(e.pointerId);
    this.pointers.delete(e.pointerId);
    if (!p) return;
    if (p.role === 'thing' && p.moved) {
      app.endDrag();
    }
    if (!p.moved && app.mode.value === 'design' && app.scene.value && app.eye.value) {
      const found = pick(app.scene.value, app.eye.value, this.ray(e));
      app.tab.value = app.tab.value === 'text' ? 'text' : 'things';
      app.selection.value = found.object >= 0 ? { kind: 'object', index: found.object } : found.wall >= 0 ? { kind: 'wall', index: found.wall } : { kind: 'room' };
    }
  }

  // ---- walking ---------------------------------------------------------------------------------------------------------------------

  go(ahead: number, aside: number): void {
    const s = app.scene.value, eye = app.eye.value;
    if (!s || !eye) return;
    app.eye.value = step(eye, s.room, ahead, aside, app.throughMirrors.value);
    app.stepped.value = true;
  }

  private walkKeys(dt: number): boolean {
    const s = app.scene.value;
    if (!s || !app.eye.value) return false;
    const down = (...codes: string[]) => (codes.some((c) => this.keys.has(c)) ? 1 : 0);
    const design = app.mode.value === 'design';
    let ahead = down('KeyW', 'ArrowUp') - down('KeyS', 'ArrowDown');
    let aside = down('KeyD') - down('KeyA');
    let turn = down('KeyQ', 'ArrowLeft') - down('KeyE', 'ArrowRight');
    const rise = down('KeyR') - down('KeyF');
    for (const p of this.pointers.values())
      if (p.role === 'walk' && p.moved) {
        ahead += Math.max(-1, Math.min(1, (p.startY - p.y) / 56));
        aside += Math.max(-1, Math.min(1, (p.x - p.startX) / 56));
      }
    void design;
    if (!ahead && !aside && !turn && !rise) return false;
    const speed = 0.55 * Math.max(0.5, Math.min(1.5, s.room.inradius || 1)) * (down('ShiftLeft', 'ShiftRight') ? 2.5 : 1) * dt;
    let eye = app.eye.value;
    if (ahead || aside) eye = step(eye, s.room, ahead * speed, aside * speed, app.throughMirrors.value);
    if (rise) eye = lift(eye, s.room, rise * speed);
    if (turn) eye = { ...eye, yaw: eye.yaw + turn * 1.6 * dt };
    app.eye.value = eye;
    app.stepped.value = true;
    return true;
  }

  // ---- drawing ---------------------------------------------------------------------------------------------------------------------

  shot(): Shot {
    const s = app.scene.value!;
    const chosen = app.selection.value;
    const name = chosen.kind === 'object' && app.mode.value === 'design' ? s.objects[chosen.index]?.name : undefined;
    const selected = name === undefined ? undefined : s.meshes.parts.find((p) => p.name === name)?.part;
    return { ...lens(), scale: this.exact ? 1 : scales[this.level]!, detail: this.exact ? 'exact' : 'rest', ...(selected === undefined ? {} : { selected }) };
  }

  private frame(now: number): void {
    requestAnimationFrame((t) => this.frame(t));
    const dt = Math.min(0.1, (now - this.last) / 1000);
    this.last = now;
    if (!app.scene.value || !app.eye.value || app.fatal.value || app.empty.value) return;
    const moved = this.walkKeys(dt);
    app.walking.value = moved || [...this.pointers.values()].some((p) => p.moved);
    try {
      // Light comes in many pieces: the picture follows twice a second.
      const lightIsDue = this.newLight && (now - this.lastLive > 500 || app.lightShare.value >= 1);
      if (this.dirty || moved || lightIsDue) this.live();
      else if (app.lightShare.value < 1 && this.smoothed > 0) return;
      else this.rest(now);
    } catch (error) {
      app.fatal.value = String(error instanceof Error ? error.message : error);
    }
  }

  private live(): void {
    const { gl } = this.view;
    const begin = performance.now();
    this.dirty = this.newLight = false;
    this.lastLive = begin;
    this.truth.stop();
    const built = this.view.built;
    this.view.draw({ ...this.shot(), detail: this.exact ? 'exact' : 'moving' });
    this.view.show();
    this.view.restartMean();
    this.smoothed = 0;
    gl.finish();
    const took = performance.now() - begin;
    if (this.view.built > built) return;
    this.frames.push(took);
    if (this.frames.length > 120) this.frames.shift();
    // Slower than 22 frames a second: coarser pictures, until they are fast enough.
    if (took > 45) (++this.slow, (this.fast = 0));
    else if (took < 16) (++this.fast, (this.slow = 0));
    else this.slow = this.fast = 0;
    if (this.slow >= 2 && this.level < scales.length - 1) (++this.level, (this.slow = 0));
    if (this.fast >= 40 && this.level > 0) (--this.level, (this.fast = 0));
  }

  /** At rest the picture is drawn at full size, then smoothed by the mean of pictures shifted by parts of a pixel, then traced. */
  private rest(now: number): void {
    const waited = now - this.restSince;
    if (waited < 180 || app.dragging.value) return;
    const count = this.exact ? 1 : this.view.isSoftware ? 4 : 9;
    if (this.smoothed < count) {
      const i = this.smoothed++;
      const jitter: [number, number] = this.exact ? [0, 0] : [((i * 3 + 1) % count) / count - 0.5 + 0.5 / count, (i + 0.5) / count - 0.5];
      this.view.draw({ ...this.shot(), scale: 1, jitter });
      this.view.showMean();
      if (this.smoothed === count) this.truth.remember();
      return;
    }
    if (!app.stale.value && app.lightShare.value >= 1) this.truth.run(this.shot());
  }
}
