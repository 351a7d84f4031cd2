// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The part as measured, in three dimensions: turns with the mouse, the keys and buttons; values under the pointer.
import {
  Box3, Box3Helper, BufferGeometry, Color, Float32BufferAttribute, LineBasicMaterial, LineSegments, OrthographicCamera, Scene, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import { ColorScale, legend, type ScaleRange } from "./color_scale";
import { h } from "./dom";
import { count, fixed, micrometres } from "./number";
import { drawTriad, triadElement, turnByKey, views } from "./orbit";
import { PointCloud, type PointData } from "./point_cloud";
import { followTheme, token, type Drawing } from "./theme";

export { views };
const pickRadius_px = 14;

export class DeviationMap implements Drawing {
  readonly element: HTMLElement;
  private readonly canvas: HTMLCanvasElement;
  private readonly renderer: WebGLRenderer | undefined;
  private readonly camera = new OrthographicCamera();
  private readonly scene = new Scene();
  private readonly cloud: PointCloud;
  private readonly box: Box3Helper;
  private readonly lines = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ depthTest: false }));
  private controls: OrbitControls | undefined;
  private readonly axes = triadElement();
  private readonly tip = h("div", { class: "tip", hidden: true });
  private legendElement: SVGElement | undefined;
  private asked = false;

  constructor(private readonly data: PointData, private readonly range: ScaleRange, private deviation_mm: number[]) {
    this.canvas = h("canvas", { tabindex: "0", role: "img",
      "aria-label": `Deviation map of ${count(data.x_mm.length)} points; arrow keys turn it, plus and minus zoom` });
    this.element = h("div", { class: "map" }, this.canvas, this.axes, this.tip);
    this.cloud = new PointCloud(data);
    this.box = this.boundingBox();
    this.scene.add(this.cloud.points, this.box);
    this.renderer = this.makeRenderer();
    if (!this.renderer) return;
    this.controls = this.makeControls();
    this.listen();
    this.look(views.Oblique);
    this.redraw();
    new ResizeObserver(() => this.fit()).observe(this.element);
    followTheme(this);
  }

  /** False where points come without normals. */
  get canLift(): boolean {
    return this.cloud.canLift;
  }

  lift(factor: number): void {
    this.cloud.setLift(factor);
    this.ask();
  }

  size(size_px: number): void {
    this.cloud.setSize(size_px * devicePixelRatio);
    this.ask();
  }

  /** Lines over the points, e.g. a path: x, y, z of its places; a new `run` begins a new line. */
  trace(position_mm: number[], run: number[]): void {
    const where: number[] = [];
    const c = this.cloud.center;
    for (let i = 1; i < run.length; ++i) {
      if (run[i] !== run[i - 1]) continue;
      for (const k of [i - 1, i])
        where.push((position_mm[3 * k] as number) - c.x, (position_mm[3 * k + 1] as number) - c.y, (position_mm[3 * k + 2] as number) - c.z);
    }
    this.lines.geometry.setAttribute("position", new Float32BufferAttribute(where, 3));
    this.lines.frustumCulled = false;
    this.lines.renderOrder = 1;
    this.scene.add(this.lines);
    this.element.dataset["trace"] = String(where.length / 6);
    this.redraw();
  }

  showTrace(visible: boolean): void {
    this.lines.visible = visible;
    this.ask();
  }

  /** The same points with other deviations, e.g. in the fixed datums. */
  show(deviation_mm: number[]): void {
    this.deviation_mm = deviation_mm;
    this.redraw();
  }

  look(from: Vector3): void {
    this.camera.up.set(0, 0, 1);
    this.camera.position.copy(from).normalize().multiplyScalar(this.cloud.radius_mm * 4);
    this.camera.zoom = 1;
    this.camera.updateProjectionMatrix();
    this.controls?.target.set(0, 0, 0);
    this.controls?.update();
    this.ask();
  }

  redraw(paper_px?: number): void {
    if (!this.renderer) return;
    const scale = new ColorScale(this.range);
    const beyond = this.cloud.paint(scale, this.deviation_mm);
    this.renderer.setClearColor(new Color().setStyle(token("map-ground"), "srgb-linear"));
    this.lines.material.color.setStyle(token("ink"), "srgb-linear");
    (this.box.material as LineBasicMaterial).color.setStyle(token("line"), "srgb-linear");
    const fresh = legend(scale, beyond);
    this.legendElement?.remove();
    this.legendElement = fresh;
    this.element.append(fresh);
    this.fit(paper_px);
    this.draw();
  }

  private boundingBox(): Box3Helper {
    const { low, high } = this.extent();
    return new Box3Helper(new Box3(low, high), 0x888888);
  }

  private extent(): { low: Vector3; high: Vector3 } {
    const point = new Vector3();
    const box = new Box3();
    for (let i = 0; i < this.data.x_mm.length; ++i) box.expandByPoint(this.cloud.drawnAt(i, point));
    return { low: box.min, high: box.max };
  }

  private makeRenderer(): WebGLRenderer | undefined {
    try {
      // Colours are tokens of the page and pass through as they are; the buffer is kept for printing.
      const renderer = new WebGLRenderer({ canvas: this.canvas, antialias: true, preserveDrawingBuffer: true });
      renderer.outputColorSpace = "srgb-linear";
      this.size(6);
      return renderer;
    } catch {
      this.element.replaceChildren(h("div", { class: "absent" },
        "The map needs WebGL, which this browser does not offer. The deviations are in the sections below and in points.csv."));
      return undefined;
    }
  }

  private makeControls(): OrbitControls {
    const controls = new OrbitControls(this.camera, this.canvas);
    controls.enableDamping = false;
    controls.zoomToCursor = true;
    controls.addEventListener("change", () => this.ask());
    return controls;
  }

  private listen(): void {
    this.canvas.addEventListener("pointermove", (event) => this.point(event));
    this.canvas.addEventListener("pointerleave", () => (this.tip.hidden = true));
    this.canvas.addEventListener("dblclick", () => this.look(views.Oblique));
    this.canvas.addEventListener("keydown", (event) => this.key(event));
  }

  private key(event: KeyboardEvent): void {
    if (!turnByKey(this.camera, new Vector3(), event)) return;
    this.controls?.update();
    this.ask();
  }

  /** The nearest point to the pointer among those within a few pixels, the frontmost of equals. */
  private nearest(x_px: number, y_px: number): number {
    const { clientWidth, clientHeight } = this.canvas;
    const point = new Vector3();
    let best = -1;
    let best_score = pickRadius_px ** 2;
    for (let i = 0; i < this.data.x_mm.length; ++i) {
      this.cloud.drawnAt(i, point).project(this.camera);
      const dx = (point.x + 1) * 0.5 * clientWidth - x_px;
      const dy = (1 - point.y) * 0.5 * clientHeight - y_px;
      const score = dx * dx + dy * dy + (point.z + 1) * 4;
      if (score < best_score) {
        best = i;
        best_score = score;
      }
    }
    return best;
  }

  private point(event: PointerEvent): void {
    if (event.buttons !== 0) {
      this.tip.hidden = true;
      return;
    }
    const { left, top } = this.canvas.getBoundingClientRect();
    const x_px = event.clientX - left;
    const y_px = event.clientY - top;
    const index = this.nearest(x_px, y_px);
    this.tip.hidden = index < 0;
    if (index < 0) return;
    const deviation = this.deviation_mm[index] as number;
    const at = [this.data.x_mm, this.data.y_mm, this.data.z_mm].map((list) => fixed(list[index], 3)).join("\u2002");
    this.tip.replaceChildren(h("strong", {}, `${deviation > 0 ? "+" : ""}${micrometres(deviation, 2)} \u00b5m`),
      h("div", {}, `x y z  ${at} mm`));
    const right = x_px > this.canvas.clientWidth * 0.6;
    this.tip.style.left = right ? "" : `${x_px + 16}px`;
    this.tip.style.right = right ? `${this.canvas.clientWidth - x_px + 16}px` : "";
    this.tip.style.top = `${Math.max(4, y_px - 20)}px`;
  }

  private fit(paper_px?: number): void {
    const width = paper_px ?? this.element.clientWidth;
    const height = paper_px ? 360 : this.element.clientHeight;
    if (!this.renderer || width === 0 || height === 0) return;
    this.renderer.setPixelRatio(paper_px ? 2 : devicePixelRatio);
    this.renderer.setSize(width, height, false);
    // The whole cloud, the legend's strip kept free of it.
    const half = this.cloud.radius_mm * 0.92;
    const aspect = width / height;
    const shift = half * aspect * 0.06;
    Object.assign(this.camera, aspect > 1.2
      ? { left: -half * aspect + shift, right: half * aspect + shift, top: half, bottom: -half }
      : { left: -half * 1.2, right: half * 1.2, top: (half * 1.2) / aspect, bottom: (-half * 1.2) / aspect });
    this.camera.near = 0.01;
    this.camera.far = this.cloud.radius_mm * 12;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** One frame, however often it was asked for. */
  private ask(): void {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.draw();
    });
  }

  private draw(): void {
    this.renderer?.render(this.scene, this.camera);
    drawTriad(this.axes, this.camera);
    // For whoever needs to know how it is turned, tests among them.
    this.element.dataset["camera"] = this.camera.position.toArray().map((value) => value.toFixed(3)).join(" ");
  }
}
