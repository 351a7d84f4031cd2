// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Documents to draw pages from: measurements of the benchmark surface (Fountas 2017, eq. 14) with errors made by formula.

/** Park and Miller's generator: the same numbers on every machine. */
export class Random {
    constructor(seed) {
        this.state = seed;
    }
    uniform() {
        this.state = (this.state * 48271) % 2147483647;
        return this.state / 2147483647;
    }
    normal() {
        return Math.sqrt(-2 * Math.log(this.uniform())) * Math.cos(2 * Math.PI * this.uniform());
    }
}

/** Eq. 14: position and unit normal (towards +Z) at u, v. */
export function benchmarkSurface(u, v) {
    const at = [-94.4 + 88.9 * v + 5.6 * v * v, -131.3 * u + 28.1 * u * u,
        5.9 * (u * u * v * v + u * u * v) - 3.9 * v * v * u + 76.2 * u * u + 6.7 * v * v - 27.3 * u * v - 50.8 * u + 25 * v + 12.1];
    const x_v = 88.9 + 11.2 * v;
    const y_u = -131.3 + 56.2 * u;
    const z_u = 5.9 * (2 * u * v * v + 2 * u * v) - 3.9 * v * v + 152.4 * u - 27.3 * v - 50.8;
    const z_v = 5.9 * (2 * u * u * v + u * u) - 7.8 * v * u + 13.4 * v - 27.3 * u + 25;
    const normal = [-z_v / x_v, -z_u / y_u, 1];
    const length = Math.hypot(...normal);
    return { at, normal: normal.map((n) => n / length) };
}

const parameterOfX = (x) => (-88.9 + Math.sqrt(88.9 ** 2 + 4 * 5.6 * (94.4 + x))) / (2 * 5.6);
const parameterOfY = (y) => (131.3 - Math.sqrt(131.3 ** 2 + 4 * 28.1 * y)) / (2 * 28.1);

/** Scallops of a 4.9 mm step-over, a slow form error, noise: mm. */
function error(u, v, random) {
    const scallop = 0.0042 * (Math.abs(Math.sin((Math.PI * 103.2 * u) / 4.9)) - 0.6);
    const form = 0.004 * Math.sin(5 * v + 2) * Math.cos(3.2 * u) + 0.0035 * (v - 0.5) ** 2 * 4;
    return scallop + form + 0.0006 * random.normal();
}

/** As inspect's DeviationStatistics. */
export function statistics(values) {
    const n = values.length;
    const mean = values.reduce((sum, d) => sum + d, 0) / n;
    const square = values.reduce((sum, d) => sum + d * d, 0) / n;
    return {
        count: n, min_mm: Math.min(...values), max_mm: Math.max(...values), mean_mm: mean, rms_mm: Math.sqrt(square),
        standard_deviation_mm: Math.sqrt((square - mean * mean) * n / (n - 1)), profile_mm: 2 * Math.max(...values.map(Math.abs)),
    };
}

const limits = [-0.01, 0.01];

function decision(verdict, reason, values) {
    return {
        verdict, reason, rule: "ISO 14253-1:2017, 95 %", lower_limit_mm: limits[0], upper_limit_mm: limits[1],
        uncertainty: { standard_mm: 0.0008, stated: true, source: "Stated by the user." },
        least_conforming_probability: verdict === "reject" ? 0.0001 : 0.71,
        points_outside: values.filter((d) => d < limits[0] || d > limits[1]).length,
    };
}

function evaluation(values, verdict, reason) {
    const bin_width_mm = 0.0005;
    const low_mm = Math.floor(Math.min(...values) / bin_width_mm) * bin_width_mm;
    const counts = new Array(Math.floor((Math.max(...values) - low_mm) / bin_width_mm) + 1).fill(0);
    for (const value of values) ++counts[Math.min(counts.length - 1, Math.floor((value - low_mm) / bin_width_mm))];
    return { ...statistics(values), beyond_edge: 0, outliers: 0, histogram: { low_mm, bin_width_mm, counts }, decision: decision(verdict, reason, values) };
}

function section(x, random) {
    const v = parameterOfX(x);
    const curve = { arc_length_mm: [], deviation_mm: [] };
    let arc = 0;
    let last = null;
    for (let y = -0.5; y > -103; y -= 0.5) {
        const u = parameterOfY(y);
        const { at } = benchmarkSurface(u, v);
        if (last) arc += Math.hypot(...at.map((c, i) => c - last[i]));
        last = at;
        curve.arc_length_mm.push(arc);
        curve.deviation_mm.push(error(u, v, random));
    }
    return { label: `X=${x}`, axis: "X", position_mm: x, length_mm: arc, beyond_edge: 0, deviation: statistics(curve.deviation_mm), curve };
}

function map(rows, columns, random) {
    const out = { x_mm: [], y_mm: [], z_mm: [], normal_x: [], normal_y: [], normal_z: [], deviation_mm: [], datum_deviation_mm: [] };
    for (let i = 0; i < rows; ++i) {
        for (let j = 0; j < columns; ++j) {
            const [u, v] = [i / (rows - 1), j / (columns - 1)];
            const { at, normal } = benchmarkSurface(u, v);
            const deviation = error(u, v, random);
            ["x_mm", "y_mm", "z_mm"].forEach((key, k) => out[key].push(at[k]));
            ["normal_x", "normal_y", "normal_z"].forEach((key, k) => out[key].push(normal[k]));
            out.deviation_mm.push(deviation);
            out.datum_deviation_mm.push(deviation + 0.004 + 0.00005 * at[1]);
        }
    }
    return { ...out, best_fit_deviation_mm: out.deviation_mm };
}

const alignment = {
    fit: "least-squares", rotation_vector_rad: [-0.00012, 0.00031, 0], translation_mm: [0.0124, -0.0087, 0.0041],
    termination: "converged", iterations: 4, coarse_iterations: 7, points: 12000, beyond_edge: 0, start_rms_mm: 0.1212, rms_mm: 0.00288, minimax_mm: 0.00958,
    locked: ["rz"], condition: 312.4, weakly_determined: ["tx", "ty"],
    standard_deviation: { tx_mm: 0.0011, ty_mm: 0.0009, tz_mm: 0.00004, rx_rad: 0.0000011, ry_rad: 0.0000012, rz_rad: 0 },
};

/** A report as `cusp inspect` writes it, with everything the page can show. */
export function inspectionSample({ rows = 100, columns = 120, seed = 7 } = {}) {
    const random = new Random(seed);
    const points = map(rows, columns, random);
    const sections = [-5, -30, -60, -90].map((x) => section(x, random));
    sections[0].scallops = { count: 21, planned_count: 21, mean_spacing_mm: 4.93, planned_step_over_mm: 4.9, mean_height_mm: 0.0041, max_height_mm: 0.0052 };
    const largest = points.deviation_mm.map((d, i) => [Math.abs(d), i]).sort((a, b) => b[0] - a[0]).slice(0, 10).map(([, i]) => i);
    const best = evaluation(points.deviation_mm, "undecided", "The largest deviation lies closer to the upper limit than its uncertainty allows.");
    return {
        schema: 1, command: "inspect", version: "0.1.0", title: "Sculptured benchmark part", points_file: "part-17.csv", nominal_file: "surface.toml",
        points: points.x_mm.length,
        measured: { format: "csv", mm_per_unit: 1, unit_stated: false, kind: "centre", kind_source: "flag", probe_radius_mm: 1 },
        alignment, judged: "best-fit", deviation: best, best_fit_deviation: best,
        datum_deviation: evaluation(points.datum_deviation_mm, "reject", "133 points lie beyond the upper limit."),
        outlier_rule: { factor: 5, floor_mm: 0.0001 }, sections, decision: best.decision, map: points,
        worst: largest.map((i) => ({ point: i, x_mm: points.x_mm[i], y_mm: points.y_mm[i], z_mm: points.z_mm[i], deviation_mm: points.deviation_mm[i] })),
        notes: ["Sliding along the surface is weakly determined: x and y are known to about 1 \u00b5m only."],
    };
}

/** Names, units and values like those of Fountas 2017, fig. 12. */
const fig12 = [["a", 0.3, "um"], ["q", 0.369, "um"], ["p", 0.93, "um"], ["v", 0.89, "um"], ["t", 1.82, "um"], ["sk", 0.0877, ""], ["z", 1.82, "um"],
    ["Dq", 4.04, "deg"], ["Tp", 56.4, "percent", "1 um under the highest peak"], ["Vo", 0.000395, "mm3_per_mm2", "lid at 20%"], ["Sm", 0.0444, "mm"],
    ["zJIS", 1.27, "um"], ["HSC", 21, "peaks", "1 um under the highest peak"], ["fd", 1.36, ""]];

/** A stylus profile as `cusp texture` writes it. */
export function textureSample({ points = 6000, seed = 3 } = {}) {
    const random = new Random(seed);
    const x_mm = Array.from({ length: points }, (_, i) => i * 0.001);
    let noise = 0;
    const waviness_um = x_mm.map((x) => 0.25 * Math.sin(2.2 * x + 1));
    const roughness_um = x_mm.map((x) => {
        noise = 0.9 * noise + 0.04 * random.normal();
        return 0.4 * Math.sin(2 * Math.PI * x / 0.0444 + 0.5 * Math.sin(9 * x)) + noise;
    });
    const inside = (_, i) => i >= 400 && i < points - 400;
    const parameters = (letter) => fig12.map(([name, value, unit, condition]) => ({
        name: letter + name, value: letter === "W" && name === "zJIS" ? null : value, unit, ...(condition ? { condition } : {}), source: "ISO 4287:1997",
    }));
    return {
        schema: 1, command: "texture", version: "0.1.0",
        profiles: [{
            profile_file: "Scan5535.csv", points, spacing_mm: 0.001, length_mm: 5.999, tip_radius_mm: 0.005, cutoff_mm: 0.8,
            form: "Form: levelled by a least-squares line.", notes: ["Gaussian filter (ISO 16610-21), cut-off 0.8 mm."],
            parameters: { P: parameters("P"), R: parameters("R"), W: parameters("W") },
            curves: {
                primary: { x_mm, height_um: x_mm.map((_, i) => waviness_um[i] + roughness_um[i]), waviness_um: waviness_um.map((w, i) => (inside(w, i) ? w : null)) },
                roughness: { x_mm: x_mm.filter(inside), height_um: roughness_um.filter(inside) },
            },
        }],
    };
}

/** Three characteristics over 24 parts as `cusp capability` writes them: one capable, one drifting out, one without limits. */
export function capabilitySample({ parts = 24, seed = 11 } = {}) {
    const random = new Random(seed);
    const order = Array.from({ length: parts }, (_, i) => i);
    const make = (name, lower, upper, value, trend_probability) => {
        const values_mm = order.map(value);
        const { mean_mm, standard_deviation_mm: s, min_mm, max_mm } = statistics(values_mm);
        const near = lower === null ? null : Math.min(upper - mean_mm, mean_mm - lower) / (3 * s);
        return {
            name, kind: "Diameter", feature: "BORE", target_mm: 10, lower_mm: lower, upper_mm: upper, count: parts, mean_mm, min_mm, max_mm,
            overall_deviation_mm: s, within_deviation_mm: s, cp: lower === null ? null : (upper - lower) / (6 * s), cpk: near,
            pp: lower === null ? null : (upper - lower) / (6 * s), ppk: near, beyond_limits: values_mm.filter((v) => lower !== null && (v < lower || v > upper)).length,
            slope_mm_per_part: 0.001, trend_probability, out_of_control: [], values_mm, parts: order,
        };
    };
    return {
        schema: 1, command: "capability", version: "0.1.0",
        files: [{ file: "/parts/results.qif", qif_version: "3.0.0", parts, measurements: 3 * parts, without_value: 0 }],
        parts: order.map((i) => `part ${i + 1}`),
        characteristics: [
            make("GOOD", 9.9, 10.1, () => 10 + 0.015 * random.normal(), 0.4),
            make("DRIFTING", 9.9, 10.1, (i) => 9.98 + 0.006 * i + 0.01 * random.normal(), 0.0001),
            make("FREE", null, null, () => 10 + 0.01 * random.normal(), 0.7),
        ],
    };
}

/** A block with a groove across, as `cusp simulate` writes it: a coarse mesh, a path of two passes, one collision. */
export function simulationSample({ collisions = 1 } = {}) {
    const n = 24;
    const depth = (x, y) => -4 * Math.exp(-((y - 0.2 * x) ** 2) / 18);
    const block = (height) => {
        const vertices_mm = [];
        const triangles = [];
        const at = (i) => -20 + (40 * i) / n;
        for (let i = 0; i <= n; ++i) for (let j = 0; j <= n; ++j) vertices_mm.push(at(i), at(j), height(at(i), at(j)));
        const below = vertices_mm.length / 3;
        for (let i = 0; i <= n; ++i) for (let j = 0; j <= n; ++j) vertices_mm.push(at(i), at(j), -12);
        const index = (i, j) => i * (n + 1) + j;
        for (let i = 0; i < n; ++i) {
            for (let j = 0; j < n; ++j) {
                const [a, b, c, d] = [index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)];
                triangles.push(a, b, c, a, c, d, below + a, below + c, below + b, below + a, below + d, below + c);
            }
            for (const [a, b] of [[index(i, 0), index(i + 1, 0)], [index(i + 1, n), index(i, n)], [index(0, i + 1), index(0, i)], [index(n, i), index(n, i + 1)]]) {
                triangles.push(a, below + a, below + b, a, below + b, b);
            }
        }
        return { vertices_mm, triangles };
    };
    const packed = (list) => Buffer.from(list.buffer).toString("base64");
    const pack = ({ vertices_mm, triangles }) => ({ vertices_mm: packed(Float32Array.from(vertices_mm)), triangles: packed(Uint32Array.from(triangles)) });
    const after = block(depth);
    const path = { tip_mm: [], axis: [], move: [], tool: [], rapid: [], line: [], every: 1 };
    for (let i = 0; i <= 80; ++i) {
        const x = i <= 40 ? -20 + i : 60 - i;
        const lean = 0.3 * Math.sin(i / 13);
        path.tip_mm.push(x, 0.2 * x, -4);
        path.axis.push(Math.sin(lean), 0, Math.cos(lean));
        path.move.push(i);
        path.tool.push(0);
        path.rapid.push(i < 2 ? 1 : 0);
        path.line.push(i + 9);
    }
    const hit = { with: "stock", part: "holder", move: 30, cl_line: 39, position_mm: [9, 4, 0.4], depth_mm: 0.812, volume_mm3: 14.2 };
    return {
        schema: 1, command: "simulate", version: "0.1.0", file: "parts/groove.cls", nominal: "groove.toml", program: false,
        moves: 81, resolution_mm: 0.1, mesh_mm: 1.7, seconds: 0.4, removed_volume_mm3: 2105.4, tolerance_mm: 0.05,
        overcut_max_mm: 0.0123, undercut_max_mm: 0.0481, within_tolerance_percent: 100, collision_volume_mm3: 14.2 * collisions,
        collision_count: collisions, collisions: Array.from({ length: collisions }, () => hit),
        machine: null, machine_range_violations: null, machine_range: [],
        before: pack(block(() => 0)), after: pack(after),
        deviation_mm: packed(Float32Array.from(after.vertices_mm.filter((_, i) => i % 3 === 2).map((z, i) => (z > -0.2 || z < -11 ? NaN : 0.06 * Math.sin(i / 40))))),
        path,
        tool_shapes: [{ name: "BALL_6", bodies: [
            { part: "cutter", profile_mm: [[0, 0], [1.5, 0.4], [2.6, 1.5], [3, 3], [3, 12], [0, 12]] },
            { part: "shank", profile_mm: [[0, 12], [3, 12], [4, 26], [0, 26]] },
            { part: "holder", profile_mm: [[0, 26], [9, 26], [12, 40], [0, 40]] },
        ] }],
    };
}

/** Three runs over twenty generations as `cusp tilt` writes them, climbing to 1 by formula. */
export function tiltSample({ runs = 3, generations = 20, free = true } = {}) {
    const climb = (pace, run) => Array.from({ length: generations + 1 }, (_, g) => Math.min(1, 1 - Math.exp(-(g + 1 + run) / pace)));
    const contact = (speed) => ({ speed_min_m_per_min: speed / 4, speed_mean_m_per_min: speed, speed_max_m_per_min: 2 * speed, force_proxy_mean: 1.4, force_proxy_max: 2.1, places: 900 });
    const proof = (volume) => ({ collision_volume_mm3: volume, depth_mm: volume > 0 ? 1.25 : 0, collisions: volume > 0 ? 40 : 0, deepest_at_mm: null });
    return {
        schema: 1, command: "tilt", version: "0.1.0", job: "cavity.toml", name: "CAVITY", machine: "A/C trunnion", cl_file: "out/tilted.apt",
        cutter_locations: 941, path_length_mm: 1569.2, collision_free: free, tilt_points_mm: [[-1.25, 0.5, 33.75]], generations_to_collision_free: 1,
        fitness: { range_excess: 0, collision_volume_mm3: 0, harmony_s: 99.93 }, rotary_travel_deg: [1850.2, 412.6], rewinds: 0, machining_time_s: 71.4,
        shortest_stick_out_mm: 41.5, stick_out_mm: 46, center_error_max_mm: 0.0002, proof_resolution_mm: 0.2,
        start: { proof: proof(85.2), contact: contact(12.5) }, tilted: { proof: proof(free ? 0 : 0.4), contact: contact(61.3) }, seed: 1,
        posted: free ? { pass: true, not_posted: null, excursions: 0, verify_pass: true, points: 941, matched: 941, simulated: proof(0) } : { pass: false, not_posted: null, excursions: 0, verify_pass: null, simulated: null },
        runs: Array.from({ length: runs }, (_, i) => ({ seed: i + 1, tilt_points_mm: [[i - 1.25, 0.5, 33.75]], generations_to_collision_free: i, evaluations: 2550, fitness: { range_excess: 0, collision_volume_mm3: 0, harmony_s: 99.93 + i } })),
        curves: Array.from({ length: runs }, (_, i) => ({ seed: i + 1, best: climb(0.4, i), mean: climb(3, i), worst: climb(9, i) })),
        seconds: 12.5,
    };
}

/** The benchmark surface with ripples along 14 passes, as `cusp optimize` writes it in true mode. */
export function optimizationSample({ mode = "true", before = true, rows = 40, columns = 44 } = {}) {
    const map = { x_mm: [], y_mm: [], z_mm: [], normal_x: [], normal_y: [], normal_z: [], deviation_mm: [] };
    const before_deviation_mm = [];
    for (let i = 0; i < rows; ++i) {
        for (let j = 0; j < columns; ++j) {
            const [u, v] = [i / (rows - 1), j / (columns - 1)];
            const { at, normal } = benchmarkSurface(u, v);
            ["x_mm", "y_mm", "z_mm"].forEach((key, k) => map[key].push(at[k]));
            ["normal_x", "normal_y", "normal_z"].forEach((key, k) => map[key].push(normal[k]));
            map.deviation_mm.push(0.0088 * Math.sin(14 * Math.PI * u) ** 2 - 0.004);
            before_deviation_mm.push(0.02 * Math.sin(9 * Math.PI * u));
        }
    }
    const path = { position_mm: [], pass: [] };
    for (let pass = 0; pass < 14; ++pass)
        for (let k = 0; k <= 20; ++k) {
            path.position_mm.push(...benchmarkSurface((pass + 0.5) / 14, (pass % 2 === 0 ? k : 20 - k) / 20).at);
            path.pass.push(pass);
        }
    const generations = Array.from({ length: 12 }, (_, g) => g);
    const names = ["tool", "width_share", "depth_share", "curvature_safety"];
    const front = (passes, time, deviation, on_front) => ({ tool: "FLAT_16", passes, machining_time_s: time, deviation_mm: deviation, on_front });
    return {
        schema: 1, command: "optimize", version: "0.1.0", job: "true.toml", folder: "out", name: "Benchmark", mode, planner: "cusp",
        best: { tool: "FLAT_16" }, objective: 1.25, cc_points: 530, passes: 14, mean_chord_error_mm: 0.00087,
        overcut_max_mm: 0.0078, undercut_max_mm: 0.0089, within_tolerance_percent: 100, reached_percent: 100, tolerance_mm: 0.01, grid_mm: 0.1,
        machining_time_s: 60.1, evaluations: 96, viral_evaluations: 9, levelled_paths: 4, seed: 1, tools: ["FLAT_12", "FLAT_16"],
        before: before ? { name: "best constant lead", tool: "TORUS_16_R3", passes: 28, cc_points: 901, machining_time_s: 118.3, overcut_max_mm: 0.02, undercut_max_mm: 0.02, within_tolerance_percent: 61.2 } : null,
        convergence: {
            evaluations: generations.map((g) => 8 * (g + 1)), viral_evaluations: generations.map((g) => Math.floor(0.8 * g)),
            best: generations.map((g) => 1.25 + 0.5 * Math.exp(-g / 3)), mean: generations.map((g) => 1.4 + Math.exp(-g / 3)),
            worst: generations.map((g) => 1.9 + 2 * Math.exp(-g / 3)), diversity: generations.map((g) => 0.9 * Math.exp(-g / 6)),
        },
        candidates: {
            names, lower: [0, 0.8, -0.9, 1], upper: [1, 1.4, -0.5, 1.2], objectives: Array.from({ length: 96 }, (_, i) => 1.25 + Math.abs(Math.sin(7 * i)) * Math.exp(-i / 40)),
            population: Array.from({ length: 8 }, (_, i) => ({ values: [i % 2, 1 + i / 40, -0.7, 1.1], objective: 1.25 + i / 100 })),
        },
        front: mode === "true" ? [front(12, 51.2, 0.0131, true), front(13, 55.2, 0.0097, true), front(14, 60.1, 0.0092, true), front(15, 64.2, 0.0093, false)] : [],
        map: { ...map, ...(before ? { before_deviation_mm } : {}) }, path,
    };
}

/** A demo's document: a pivot error in four sections, its correction, and what a calibration said. */
export function loopSample() {
    const random = new Random(20260917);
    const arc_length_mm = Array.from({ length: 200 }, (_, i) => i * 0.55);
    const curve = (size, wave) => arc_length_mm.map((s) => size * Math.sin(s / 40 + wave) - size / 3 + 0.002 * Math.sin(s * 2.4) + 0.0005 * random.normal());
    const largest = (values) => Math.max(...values.map(Math.abs));
    const sections = ["X=-5", "X=-30", "X=-60", "X=-90"].map((label, i) => {
        const datum = { before_mm: curve(0.026, i / 4), uncorrected_mm: curve(0.026, i / 4), after_mm: curve(0.0008, i) };
        const best_fit = { before_mm: curve(0.003, i / 4), after_mm: curve(0.0007, i) };
        return {
            label, points: arc_length_mm.length, before_mm: largest(datum.before_mm), uncorrected_mm: largest(datum.uncorrected_mm),
            after_mm: largest(datum.after_mm), before_best_fit_mm: largest(best_fit.before_mm), after_best_fit_mm: largest(best_fit.after_mm),
            curves: { arc_length_mm, datum, best_fit },
        };
    });
    const part = (key, folder) => ({
        max_abs_deviation_mm: Math.max(...sections.map((s) => s[key])), rms_deviation_mm: 0.4 * Math.max(...sections.map((s) => s[key])),
        best_fit_max_abs_deviation_mm: 0.005, true_max_abs_deviation_mm: 0.98 * Math.max(...sections.map((s) => s[key])), report: `${folder}/report.html`,
    });
    const parameter = (name, state, value, interval_95, more = {}) => ({
        name, meaning: "", state, value, interval_95, standard_uncertainty: interval_95 === null ? null : interval_95 / 1.96,
        significant: false, known: false, with: [], remedy: null, ...more,
    });
    return {
        schema: 1, command: "demo", version: "0.1.0", machine: "Fooke Endura class, C/A head", seed: 1, limit_mm: 0.01,
        before: part("before_mm", "before"), uncorrected: part("uncorrected_mm", "uncorrected"), after: part("after_mm", "after"),
        calibrated: part("after_mm", "calibrated"), sections,
        hidden: [{ name: "pivot_length_mm", value: 0.0512 }, { name: "tool_length_mm", value: -0.011 }, { name: "lag_X_ms", value: 0.8 }],
        compensation: { moved: 2400, locations: 2521, clamped: 0, max_shift_mm: 0.031, gouge_mm: 0.0002, shortest_wave_mm: 25.8 },
        remains: [{ what: "path: scallops and chords", mm: 0.0039 }, { what: "measuring: noise (2\u03c3), form, drift", mm: 0.0017 }],
        calibration: {
            points: 396, rms_mm: 0.0005, noise_mm: 0.0005,
            parameters: [
                parameter("pivot_length_mm", "identified", 0.0508, 0.0041, { significant: true }),
                parameter("tool_length_mm", "identified", -0.0105, 0.0038, { significant: true, known: true }),
                parameter("lag_X_ms", "inseparable", null, null, { remedy: "record a circular test" }),
            ],
        },
        link: { address: "modbus-tcp://127.0.0.1:40123", bytes: 184233, seconds: 0.42, chunks: 812, chunks_repeated: 0, compared: true },
        blocks: 2604, run_s: 151.2, seconds: 24.8,
    };
}
