// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What pictures in three dimensions have in common: keys that turn and zoom, and the little axes in the corner.
import { Vector3, type OrthographicCamera } from "three";

import { svg } from "./dom";

/** Directions to look from. */
export const views = {
  Oblique: new Vector3(0.75, -1.1, 0.8), Top: new Vector3(0, -1e-4, 1), Front: new Vector3(0, -1, 0), Right: new Vector3(1, 0, 0),
};

const keyStep_rad = Math.PI / 24;

/** Arrow keys turn about `center`, plus and minus zoom; false for any other key. */
export function turnByKey(camera: OrthographicCamera, center: Vector3, event: KeyboardEvent): boolean {
  const turn: Record<string, [number, number]> = {
    ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1],
  };
  const zoom: Record<string, number> = { "+": 1.2, "-": 1 / 1.2 };
  const [around, over] = turn[event.key] ?? [0, 0];
  const factor = zoom[event.key];
  if (around === 0 && over === 0 && factor === undefined) return false;
  event.preventDefault();
  const position = camera.position.clone().sub(center);
  const polar = Math.acos(position.z / position.length());
  const wanted = Math.max(1e-3, Math.min(Math.PI - 1e-3, polar + over * keyStep_rad));
  const azimuth = Math.atan2(position.y, position.x) + around * keyStep_rad;
  const length = position.length();
  position.set(length * Math.sin(wanted) * Math.cos(azimuth), length * Math.sin(wanted) * Math.sin(azimuth), length * Math.cos(wanted));
  camera.position.copy(position.add(center));
  if (factor) camera.zoom *= factor;
  camera.updateProjectionMatrix();
  return true;
}

export const triadElement = (): SVGSVGElement => svg("svg", { class: "axes", viewBox: "-42 -42 84 84", "aria-hidden": "true" });

/** The axes as they lie in the picture, the nearest drawn last. */
export function drawTriad(element: SVGSVGElement, camera: OrthographicCamera): void {
  const parts: [number, SVGElement[]][] = ["X", "Y", "Z"].map((name, i) => {
    const tip = new Vector3().setComponent(i, 1).applyQuaternion(camera.quaternion.clone().invert());
    const line = svg("line", { x1: 0, y1: 0, x2: tip.x * 26, y2: -tip.y * 26 });
    return [tip.z, [line, svg("text", { x: tip.x * 35, y: -tip.y * 35 }, name)]];
  });
  parts.sort((a, b) => a[0] - b[0]);
  element.replaceChildren(...parts.flatMap(([, elements]) => elements));
}
