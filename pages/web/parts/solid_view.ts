// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Stock, path, collisions and the tool in three dimensions; the tool stands wherever on the path it is put.
import {
  BufferGeometry, Color, DirectionalLight, Float32BufferAttribute, Group, HemisphereLight, LatheGeometry, LineBasicMaterial,
  LineSegments, Mesh, MeshLambertMaterial, OrthographicCamera, Points, PointsMaterial, Quaternion, Scene,
  Uint32BufferAttribute, Vector2, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import { ColorScale, legend } from "./color_scale";
import { h } from "./dom";
import { views } from "./deviation_map";
import { followTheme, token, type Drawing } from "./theme";
import type { CollisionItem, PathData, ToolShape } from "../pages/simulation_input";

export type Shown = "before" | "after" | "deviation";

const partTokens: Record<string, string> = { cutter: "accent", shank: "limit", holder: "series-soft", head: "line" };
const colored = (name: string): Color => new Color().setStyle(token(name), "srgb-linear");

export interface MeshData {
  vertices_mm: Float32Array;
  triangles: Uint32Array;
}

export interface SolidData {
  before: MeshData;
  after: MeshData;
  /** At the vertices of `after`; not a number where there is none. */
  deviation_mm?: Float32Array | undefined;
  tolerance_mm: number;
  path: PathData;
  tools: ToolShape[];
  collisions: CollisionItem[];
}

export class SolidView implements Drawing {
  readonly element: HTMLElement;
  private readonly canvas: HTMLCanvasElement;
  private readonly renderer: WebGLRenderer | undefined;
  private readonly scene = new Scene();
  private readonly camera = new OrthographicCamera();
  private controls: OrbitControls | undefined;
  private readonly center = new Vector3();
  private readonly radius_mm: number;
  private readonly before: Mesh<BufferGeometry, MeshLambertMaterial>;
  private readonly after: Mesh<BufferGeometry, MeshLambertMaterial>;
  private readonly lines: LineSegments<BufferGeometry, LineBasicMaterial>;
  private readonly marks: Points<BufferGeometry, PointsMaterial>;
  private readonly tools: Group[];
  private legendElement: SVGElement | undefined;
  private shown: Shown = "after";
  private asked = false;

  constructor(private readonly data: SolidData) {
    this.canvas = h("canvas", { tabindex: "0", role: "img", "aria-label": "Stock, tool and path; drag to turn, wheel to zoom" });
    this.element = h("div", { class: "map" }, this.canvas);
    this.radius_mm = this.measure();
    this.before = this.solid(data.before);
    this.after = this.solid(data.after);
    this.lines = this.pathLines();
    this.marks = this.collisionMarks();
    this.tools = data.tools.map((tool) => this.toolGroup(tool));
    this.renderer = this.makeRenderer();
    if (!this.renderer) return;
    const sun = new DirectionalLight(0xffffff, 2.6);
    sun.position.set(-0.6, -0.7, 1);
    this.scene.add(this.before, this.after, this.lines, this.marks, ...this.tools, sun, new HemisphereLight(0xffffff, 0x999999, 2.2));
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enableDamping = false;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.ask());
    this.look(views.Oblique);
    this.redraw();
    this.show(data.deviation_mm ? "deviation" : "after");
    this.place(0);
    new ResizeObserver(() => this.fit()).observe(this.element);
    followTheme(this);
  }

  look(from: Vector3): void {
    this.camera.up.set(0, 0, 1);
    this.camera.position.copy(from).normalize().multiplyScalar(this.radius_mm * 6);
    this.camera.zoom = 1;
    this.camera.updateProjectionMatrix();
    this.controls?.target.set(0, 0, 0);
    this.controls?.update();
    this.ask();
  }

  show(what: Shown): void {
    this.shown = what;
    this.before.visible = what === "before";
    this.after.visible = what !== "before";
    this.paint();
    this.ask();
  }

  showPath(on: boolean): void {
    this.lines.visible = on;
    this.ask();
  }

  /** Puts the tool at an entry of the path's lists. */
  place(index: number): void {
    const { tip_mm, axis, tool } = this.data.path;
    this.tools.forEach((group, i) => (group.visible = i === tool[index]));
    const group = this.tools[tool[index] ?? -1];
    if (!group) return;
    const at = (list: number[]): Vector3 => new Vector3(list[3 * index], list[3 * index + 1], list[3 * index + 2]);
    group.position.copy(at(tip_mm)).sub(this.center);
    group.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), at(axis).normalize()));
    this.element.dataset["tip"] = at(tip_mm).toArray().map((value) => value.toFixed(3)).join(" ");
    this.ask();
  }

  redraw(paper_px?: number): void {
    if (!this.renderer) return;
    this.renderer.setClearColor(colored("map-ground"));
    this.lines.material.color.copy(colored("ink-soft"));
    this.marks.material.color.copy(colored("bad"));
    for (const group of this.tools) {
      for (const child of group.children) (child as Mesh<BufferGeometry, MeshLambertMaterial>).material.color.copy(colored(child.name));
    }
    this.paint();
    this.fit(paper_px);
  }

  private measure(): number {
    const low = new Vector3(Infinity, Infinity, Infinity);
    const high = new Vector3(-Infinity, -Infinity, -Infinity);
    const list = this.data.before.vertices_mm;
    for (let i = 0; i + 2 < list.length; i += 3) {
      const at = new Vector3(list[i], list[i + 1], list[i + 2]);
      low.min(at);
      high.max(at);
    }
    this.center.addVectors(low, high).multiplyScalar(0.5);
    return Math.max(high.distanceTo(low) / 2, 1e-6);
  }

  private solid(mesh: MeshData): Mesh<BufferGeometry, MeshLambertMaterial> {
    const geometry = new BufferGeometry();
    const where = new Float32Array(mesh.vertices_mm.length);
    for (let i = 0; i < where.length; ++i) where[i] = (mesh.vertices_mm[i] as number) - this.center.getComponent(i % 3);
    geometry.setAttribute("position", new Float32BufferAttribute(where, 3));
    geometry.setAttribute("color", new Float32BufferAttribute(new Float32Array(where.length).fill(1), 3));
    geometry.setIndex(new Uint32BufferAttribute(mesh.triangles, 1));
    geometry.computeVertexNormals();
    return new Mesh(geometry, new MeshLambertMaterial({ vertexColors: true }));
  }

  private pathLines(): LineSegments<BufferGeometry, LineBasicMaterial> {
    const { tip_mm, tool } = this.data.path;
    const where: number[] = [];
    for (let i = 0; i + 1 < tool.length; ++i) {
      for (let k = 0; k < 6; ++k) where.push((tip_mm[3 * i + k] as number) - this.center.getComponent(k % 3));
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new Float32BufferAttribute(where, 3));
    const out = new LineSegments(geometry, new LineBasicMaterial({ transparent: true, opacity: 0.55 }));
    out.visible = false;
    return out;
  }

  private collisionMarks(): Points<BufferGeometry, PointsMaterial> {
    const where = this.data.collisions.flatMap(({ position_mm }) => position_mm.map((value, k) => value - this.center.getComponent(k)));
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new Float32BufferAttribute(where, 3));
    const out = new Points(geometry, new PointsMaterial({ size: 9 * devicePixelRatio, sizeAttenuation: false, depthTest: false }));
    out.renderOrder = 2;
    return out;
  }

  private toolGroup(tool: ToolShape): Group {
    const group = new Group();
    for (const { part, profile_mm } of tool.bodies) {
      const lathe = new LatheGeometry(profile_mm.map(([radius, height]) => new Vector2(radius, height)), 48);
      const material = new MeshLambertMaterial({ transparent: true, opacity: part === "cutter" ? 0.95 : 0.7, side: 2 });
      const body = new Mesh(lathe, material);
      body.name = partTokens[part] ?? "limit";
      group.add(body);
    }
    group.visible = false;
    return group;
  }

  private paint(): void {
    const metal = colored("series-soft");
    const { deviation_mm, tolerance_mm } = this.data;
    const scale = new ColorScale({ low_mm: -tolerance_mm, high_mm: tolerance_mm, are_limits: true });
    const fill = (mesh: Mesh<BufferGeometry, MeshLambertMaterial>, values?: Float32Array): number => {
      const attribute = mesh.geometry.getAttribute("color");
      let beyond = 0;
      for (let i = 0; i < attribute.count; ++i) {
        const value = values?.[i];
        if (value === undefined || Number.isNaN(value)) {
          attribute.setXYZ(i, metal.r, metal.g, metal.b);
          continue;
        }
        const [r, g, b] = scale.color(value);
        attribute.setXYZ(i, r / 255, g / 255, b / 255);
        if (scale.isBeyond(value)) ++beyond;
      }
      attribute.needsUpdate = true;
      return beyond;
    };
    fill(this.before);
    const withDeviation = this.shown === "deviation" && deviation_mm !== undefined;
    const beyond = fill(this.after, withDeviation ? deviation_mm : undefined);
    this.legendElement?.remove();
    this.legendElement = undefined;
    if (!withDeviation) return;
    this.legendElement = legend(scale, beyond);
    this.element.append(this.legendElement);
  }

  private makeRenderer(): WebGLRenderer | undefined {
    try {
      // Colours are tokens of the page and pass through as they are; the buffer is kept for printing.
      const renderer = new WebGLRenderer({ canvas: this.canvas, antialias: true, preserveDrawingBuffer: true });
      renderer.outputColorSpace = "srgb-linear";
      return renderer;
    } catch {
      this.element.replaceChildren(h("div", { class: "absent" },
        "The view needs WebGL, which this browser does not offer. Pictures are beside this page: before.png, after.png, deviation.png."));
      return undefined;
    }
  }

  private fit(paper_px?: number): void {
    const width = paper_px ?? this.element.clientWidth;
    const height = paper_px ? 360 : this.element.clientHeight;
    if (!this.renderer || width === 0 || height === 0) return;
    this.renderer.setPixelRatio(paper_px ? 2 : devicePixelRatio);
    this.renderer.setSize(width, height, false);
    const aspect = width / height;
    const half = this.radius_mm * (aspect > 1.2 ? 1.05 : 1.25 / Math.min(aspect, 1));
    Object.assign(this.camera, { left: -half * aspect, right: half * aspect, top: half, bottom: -half, near: 0.01, far: this.radius_mm * 16 });
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
    this.element.dataset["camera"] = this.camera.position.toArray().map((value) => value.toFixed(3)).join(" ");
  }
}
