// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A tool path in three dimensions with the tool on it: what is programmed, what was run, where the tool is now.
import {
  Box3, BufferAttribute, BufferGeometry, Color, CylinderGeometry, Group, LineBasicMaterial, LineSegments, Mesh,
  MeshBasicMaterial, OrthographicCamera, Scene, SphereGeometry, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import { h } from "./dom";
import { drawTriad, triadElement, turnByKey, views } from "./orbit";
import { followTheme, token, type Drawing } from "./theme";

/** One of the lines: its segments, and how many of them there is room for. */
class Polyline {
  readonly lines: LineSegments;
  private readonly material = new LineBasicMaterial();
  private places = new Float32Array(0);
  private used = 0;

  constructor(private readonly color: string, order: number, opacity = 1) {
    this.material.transparent = opacity < 1;
    this.material.opacity = opacity;
    this.lines = new LineSegments(new BufferGeometry(), this.material);
    this.lines.frustumCulled = false;
    // Lines in the same place are told apart by their order: what was run lies over what was programmed.
    this.material.depthTest = false;
    this.lines.renderOrder = order;
  }

  clear(): void {
    this.used = 0;
    this.lines.geometry.setDrawRange(0, 0);
  }

  add(from: Vector3, to: Vector3): void {
    if (this.used + 6 > this.places.length) this.grow();
    from.toArray(this.places, this.used);
    to.toArray(this.places, this.used + 3);
    this.used += 6;
  }

  /** After all that was added at once. */
  upload(): void {
    const attribute = this.lines.geometry.getAttribute("position") as BufferAttribute | undefined;
    if (attribute) attribute.needsUpdate = true;
    this.lines.geometry.setDrawRange(0, this.used / 3);
  }

  paint(): void {
    this.material.color.setStyle(token(this.color), "srgb-linear");
  }

  private grow(): void {
    const wider = new Float32Array(Math.max(6 * 1024, this.places.length * 2));
    wider.set(this.places);
    this.places = wider;
    this.lines.geometry.dispose();
    this.lines.geometry = new BufferGeometry();
    this.lines.geometry.setAttribute("position", new BufferAttribute(this.places, 3));
  }
}

export class PathView implements Drawing {
  readonly element: HTMLElement;
  private readonly canvas: HTMLCanvasElement;
  private readonly renderer: WebGLRenderer | undefined;
  private readonly camera = new OrthographicCamera();
  private readonly scene = new Scene();
  private readonly planned = { cut: new Polyline("series-soft", 1, 0.9), rapid: new Polyline("line", 0) };
  private readonly done = { cut: new Polyline("accent", 3), rapid: new Polyline("limit", 2, 0.7) };
  private readonly toolMaterial = new MeshBasicMaterial({ transparent: true, opacity: 0.85 });
  private readonly tool = new Group();
  private readonly triad = triadElement();
  /** Of what is cut: the way from home would make a dot of it. Rapids count while nothing is cut. */
  private readonly cutBox = new Box3();
  private readonly wayBox = new Box3();
  private planIsKnown = false;
  private readonly center = new Vector3();
  private radius_mm = 50;
  private direction = views.Oblique;
  private controls: OrbitControls | undefined;
  private held = false;
  private last: Vector3 | undefined;
  private asked = false;

  constructor(label: string) {
    this.canvas = h("canvas", { tabindex: "0", role: "img", "aria-label": `${label}; arrow keys turn it, plus and minus zoom` });
    this.element = h("div", { class: "map path" }, this.canvas, this.triad);
    this.scene.add(this.planned.rapid.lines, this.planned.cut.lines, this.done.rapid.lines, this.done.cut.lines, this.tool);
    this.tool.visible = false;
    this.buildTool();
    this.renderer = this.makeRenderer();
    if (!this.renderer) return;
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enableDamping = false;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("start", () => (this.held = true));
    this.controls.addEventListener("change", () => this.ask());
    this.canvas.addEventListener("dblclick", () => this.look(views.Oblique));
    this.canvas.addEventListener("keydown", (event) => {
      if (!turnByKey(this.camera, this.controls?.target ?? this.center, event)) return;
      this.held = true;
      this.controls?.update();
      this.ask();
    });
    this.look(views.Oblique);
    this.redraw();
    new ResizeObserver(() => this.fit()).observe(this.element);
    followTheme(this);
  }

  /** The programmed path: x, y, z of its points, and 1 where the way to a point is a rapid. */
  showPlanned(tip_mm: number[], rapid: number[]): void {
    this.planned.cut.clear();
    this.planned.rapid.clear();
    this.cutBox.makeEmpty();
    this.wayBox.makeEmpty();
    this.planIsKnown = false;
    this.addSegments(this.planned, tip_mm, rapid.map((value) => value === 0), undefined);
    this.planIsKnown = !this.cutBox.isEmpty();
    this.grow(true);
  }

  clearDone(): void {
    this.done.cut.clear();
    this.done.rapid.clear();
    this.last = undefined;
    this.ask();
  }

  addDone(tip_mm: number[], cutting: number[]): void {
    this.last = this.addSegments(this.done, tip_mm, cutting.map((value) => value !== 0), this.last);
    this.grow(false);
  }

  placeTool(tip_mm: number[], axis: number[]): void {
    this.tool.visible = true;
    this.tool.position.fromArray(tip_mm);
    this.tool.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), new Vector3().fromArray(axis).normalize());
    this.element.dataset["tool"] = tip_mm.map((value) => value.toFixed(3)).join(" ");
    this.ask();
  }

  look(from: Vector3): void {
    this.direction = from;
    this.held = false;
    this.aim();
  }

  redraw(): void {
    if (!this.renderer) return;
    for (const line of [this.planned.cut, this.planned.rapid, this.done.cut, this.done.rapid]) line.paint();
    this.toolMaterial.color.setStyle(token("beyond"), "srgb-linear");
    this.renderer.setClearColor(new Color().setStyle(token("map-ground"), "srgb-linear"));
    this.fit();
  }

  private addSegments(lines: { cut: Polyline; rapid: Polyline }, tip_mm: number[], cutting: boolean[], before: Vector3 | undefined): Vector3 | undefined {
    let last = before;
    cutting.forEach((cuts, i) => {
      const point = new Vector3().fromArray(tip_mm, 3 * i);
      if (last) (cuts ? lines.cut : lines.rapid).add(last, point);
      if (!this.planIsKnown) (cuts ? this.cutBox : this.wayBox).expandByPoint(point);
      last = point;
    });
    lines.cut.upload();
    lines.rapid.upload();
    return last;
  }

  /** The picture follows what it shows, unless somebody has turned it. */
  private grow(always: boolean): void {
    const box = this.cutBox.isEmpty() ? this.wayBox : this.cutBox;
    if (!box.isEmpty()) {
      const radius_mm = Math.max(box.getSize(new Vector3()).length() / 2, 1);
      if (always || radius_mm > this.radius_mm * 1.02 || radius_mm < this.radius_mm * 0.5) {
        this.radius_mm = radius_mm * (always ? 1 : 1.25);
        box.getCenter(this.center);
        this.tool.scale.setScalar(this.radius_mm);
        if (!this.held) this.aim();
      }
    }
    this.ask();
  }

  private aim(): void {
    this.camera.up.set(0, 0, 1);
    this.camera.position.copy(this.direction).normalize().multiplyScalar(this.radius_mm * 6).add(this.center);
    this.camera.zoom = 1;
    this.controls?.target.copy(this.center);
    this.fit();
    this.controls?.update();
    this.ask();
  }

  /** A ball on a shank, a fixed share of the picture: it marks a place and a direction, and is no picture of the cutter. */
  private buildTool(): void {
    const shank = new Mesh(new CylinderGeometry(0.02, 0.02, 0.36, 20), this.toolMaterial);
    shank.rotation.x = Math.PI / 2;
    shank.position.z = 0.2;
    const tip = new Mesh(new SphereGeometry(0.02, 20, 12), this.toolMaterial);
    tip.position.z = 0.02;
    shank.renderOrder = tip.renderOrder = 4;
    this.tool.add(shank, tip);
    this.tool.scale.setScalar(this.radius_mm);
  }

  private makeRenderer(): WebGLRenderer | undefined {
    try {
      const renderer = new WebGLRenderer({ canvas: this.canvas, antialias: true, preserveDrawingBuffer: true });
      renderer.outputColorSpace = "srgb-linear";
      return renderer;
    } catch {
      this.element.replaceChildren(h("div", { class: "absent" }, "The picture needs WebGL, which this browser does not offer. The figures beside it do not."));
      return undefined;
    }
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (!this.renderer || width === 0 || height === 0) return;
    this.renderer.setPixelRatio(devicePixelRatio);
    this.renderer.setSize(width, height, false);
    const half = this.radius_mm * 1.15;
    const aspect = width / height;
    const [x, y] = aspect > 1 ? [half * aspect, half] : [half, half / aspect];
    Object.assign(this.camera, { left: -x, right: x, top: y, bottom: -y, near: 0.01, far: this.radius_mm * 20 });
    this.camera.updateProjectionMatrix();
    this.draw();
  }

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
    drawTriad(this.triad, this.camera);
    this.element.dataset["camera"] = this.camera.position.toArray().map((value) => value.toFixed(3)).join(" ");
  }
}
