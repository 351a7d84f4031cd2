// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Coloured points as three.js draws them: discs of a size in pixels, moved along their normals by a factor, ringed when
// beyond a limit.
import { BufferGeometry, Color, Float32BufferAttribute, Points, ShaderMaterial, Vector3 } from "three";

import type { ColorScale } from "./color_scale";
import { token } from "./theme";

/** Parallel lists, one entry a point; millimetres, normals out of the material. */
export interface PointData {
  x_mm: number[];
  y_mm: number[];
  z_mm: number[];
  deviation_mm: number[];
  normal_x?: number[];
  normal_y?: number[];
  normal_z?: number[];
}

const vertexShader = `
attribute vec3 tint;
attribute vec3 lifted;
attribute float beyond;
uniform float lift;
uniform float size_px;
uniform float grow;
varying vec3 v_tint;
varying float v_beyond;
void main() {
  v_tint = tint;
  v_beyond = beyond;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position + lifted * lift, 1.0);
  gl_PointSize = size_px * (1.0 + grow * beyond);
  gl_Position.z -= 0.0004 * beyond;
}`;

const fragmentShader = `
uniform vec3 ring;
uniform float ring_from;
varying vec3 v_tint;
varying float v_beyond;
void main() {
  float r = length(gl_PointCoord - 0.5) * 2.0;
  if (r > 1.0) discard;
  gl_FragColor = vec4(v_beyond > 0.5 && r > ring_from ? ring : v_tint, 1.0);
}`;

export class PointCloud {
  readonly points: Points<BufferGeometry, ShaderMaterial>;
  readonly center = new Vector3();
  readonly radius_mm: number;
  readonly canLift: boolean;
  private readonly where: Float32Array;
  private readonly lifted: Float32Array;

  /** Positions are kept relative to `center`, since a float is too coarse for a cloud far off its origin. */
  constructor(readonly data: PointData) {
    const n = data.x_mm.length;
    const [low, high] = boundsOf(data);
    this.center.addVectors(low, high).multiplyScalar(0.5);
    this.radius_mm = Math.max(high.distanceTo(low) / 2, 1e-6);
    this.where = new Float32Array(3 * n);
    this.lifted = new Float32Array(3 * n);
    this.canLift = data.normal_x !== undefined && data.normal_y !== undefined && data.normal_z !== undefined;
    for (let i = 0; i < n; ++i) {
      this.where[3 * i] = (data.x_mm[i] as number) - this.center.x;
      this.where[3 * i + 1] = (data.y_mm[i] as number) - this.center.y;
      this.where[3 * i + 2] = (data.z_mm[i] as number) - this.center.z;
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new Float32BufferAttribute(this.where, 3));
    const material = new ShaderMaterial({
      vertexShader, fragmentShader,
      uniforms: { lift: { value: 0 }, size_px: { value: 6 }, grow: { value: 0 }, ring_from: { value: 0 }, ring: { value: new Color() } },
    });
    this.points = new Points(geometry, material);
    this.points.frustumCulled = false;
  }

  /** How many points lie beyond a limit. */
  paint(scale: ColorScale, deviation_mm: number[]): number {
    const n = deviation_mm.length;
    const tint = new Float32Array(3 * n);
    const beyond = new Float32Array(n);
    let count = 0;
    for (let i = 0; i < n; ++i) {
      const deviation = deviation_mm[i] as number;
      const [r, g, b] = scale.color(deviation);
      tint.set([r / 255, g / 255, b / 255], 3 * i);
      if (scale.isBeyond(deviation)) {
        beyond[i] = 1;
        ++count;
      }
      if (this.canLift) {
        this.lifted[3 * i] = (this.data.normal_x?.[i] ?? 0) * deviation;
        this.lifted[3 * i + 1] = (this.data.normal_y?.[i] ?? 0) * deviation;
        this.lifted[3 * i + 2] = (this.data.normal_z?.[i] ?? 0) * deviation;
      }
    }
    const { geometry, material } = this.points;
    geometry.setAttribute("tint", new Float32BufferAttribute(tint, 3));
    geometry.setAttribute("beyond", new Float32BufferAttribute(beyond, 1));
    geometry.setAttribute("lifted", new Float32BufferAttribute(this.lifted, 3));
    // A few stand out; where they are many, rings would hide the colours of all.
    const few = count <= n / 20;
    (material.uniforms["grow"] as { value: number }).value = few ? 0.8 : 0;
    (material.uniforms["ring_from"] as { value: number }).value = few ? 0.66 : 0.88;
    (material.uniforms["ring"] as { value: Color }).value.setStyle(token("ink"), "srgb-linear");
    return count;
  }

  setLift(factor: number): void {
    (this.points.material.uniforms["lift"] as { value: number }).value = factor;
  }
  setSize(size_px: number): void {
    (this.points.material.uniforms["size_px"] as { value: number }).value = size_px;
  }

  /** Where point `index` is drawn, relative to `center`. */
  drawnAt(index: number, out: Vector3): Vector3 {
    const lift = (this.points.material.uniforms["lift"] as { value: number }).value;
    return out.set(...([0, 1, 2].map((k) =>
      (this.where[3 * index + k] as number) + lift * (this.lifted[3 * index + k] as number)) as [number, number, number]));
  }
}

function boundsOf(data: PointData): [Vector3, Vector3] {
  const low = new Vector3(Infinity, Infinity, Infinity);
  const high = new Vector3(-Infinity, -Infinity, -Infinity);
  const point = new Vector3();
  for (let i = 0; i < data.x_mm.length; ++i) {
    point.set(data.x_mm[i] as number, data.y_mm[i] as number, data.z_mm[i] as number);
    low.min(point);
    high.max(point);
  }
  return [low, high];
}
