function e(e, t) {
	for (let [n, r] of Object.entries(t)) e.setAttribute(n, String(r));
	return e;
}
function t(t, n, r = {}) {
	let i = e(document.createElementNS("http://www.w3.org/2000/svg", t), r);
	return n?.append(i), i;
}
function n(t, n, r = {}, i = "") {
	let a = e(document.createElement(t), r);
	return i && (a.textContent = i), n?.append(a), a;
}
function r(e) {
	let t = Math.round(100 * Math.min(Math.abs(e), 1e6)), n = Math.floor(t / 100), r = t % 100;
	return (e < 0 && t ? "-" : "") + n + (r ? (r < 10 ? ".0" : ".") + r : "");
}
var i = (e, t = 4) => Number.isFinite(e) ? String(+e.toPrecision(t)).replace("-", "−") : "–";
function a(e, t = !1) {
	return e.length ? "M" + e.map(([e, t]) => r(e) + " " + r(t)).join("L") + (t ? "Z" : "") : "";
}
function o(e, t, n) {
	e.setAttribute("transform", `translate(${r(t)} ${r(n)})`);
}
function s(e, t) {
	let n = new DOMPoint(t.clientX, t.clientY).matrixTransform(e.getScreenCTM().inverse());
	return [n.x, n.y];
}
function c(e, n, r) {
	e.replaceChildren();
	let i = !1;
	for (let a of n.split(/(_\{[^}]*\})/)) {
		if (!a) continue;
		let n = a.startsWith("_{"), o = t("tspan", e, n ? { "font-size": .7 * r } : {});
		o.textContent = n ? a.slice(2, -1) : a, n !== i && o.setAttribute("dy", String((n ? .25 : -.25) * r)), i = n;
	}
}
var l = (e) => e.replace(/_\{([^}]*)\}/g, "$1"), u = null, d = /* @__PURE__ */ new Map();
function f(e, t, n = !1) {
	let r = `${n}${e}`, i = d.get(r);
	if (i === void 0) {
		u ??= document.createElement("canvas").getContext("2d"), u.font = `${n ? "bold " : ""}100px "DejaVu Sans", "Helvetica Neue", Arial, sans-serif`, i = 0;
		for (let t of e.split(/(_\{[^}]*\})/)) {
			let e = t.startsWith("_{");
			i += u.measureText(e ? t.slice(2, -1) : t).width / 100 * (e ? .7 : 1);
		}
		d.set(r, i);
	}
	return i * t;
}
function p(e, n, r, i, a = "middle") {
	let o = t("text", e, {
		class: `l-${n}-t`,
		"font-size": i,
		"text-anchor": a
	});
	return c(o, r, i), o;
}
var m = class {
	g;
	shaft;
	head;
	constructor(e, n, r = "") {
		this.g = t("g", e), r && (t("title", this.g).textContent = l(r)), this.shaft = t("path", this.g, {
			class: `l-${n}`,
			style: "fill:none"
		}), this.head = t("path", this.g, { class: `l-${n}-h` });
	}
	set(e, t, n = .3) {
		let r = t[0] - e[0], i = t[1] - e[1], o = Math.hypot(r, i), s = o > n && Number.isFinite(o);
		if (this.g.setAttribute("display", s ? "inline" : "none"), !s) return !1;
		let c = r / o, l = i / o, u = Math.min(3, .75 * o), d = .3 * u, f = [t[0] - u * c, t[1] - u * l];
		return this.shaft.setAttribute("d", a([e, [t[0] - .8 * u * c, t[1] - .8 * u * l]])), this.head.setAttribute("d", a([
			t,
			[f[0] - d * l, f[1] + d * c],
			[f[0] + d * l, f[1] - d * c]
		], !0)), !0;
	}
};
function h(e) {
	let t = [...e].sort((e, t) => e[0] - t[0] || e[1] - t[1]), n = (e, t, n) => (t[0] - e[0]) * (n[1] - e[1]) - (t[1] - e[1]) * (n[0] - e[0]), r = (e) => {
		let t = [];
		for (let r of e) {
			for (; t.length > 1 && n(t[t.length - 2], t[t.length - 1], r) <= .01;) t.pop();
			t.push(r);
		}
		return t;
	};
	return [...r(t).slice(0, -1), ...r(t.reverse()).slice(0, -1)];
}
// src/gap.ts
function g(n, o, s) {
	let c = t("g", n.svg, {
		class: "gaps",
		"pointer-events": "none"
	}), { unit: l, size: u } = o.units.length, d = "";
	return () => {
		let o = s.open.map((e) => {
			let [t, r] = [e.p, e.q].map((e) => n.paper.of(...n.paper.project(e)));
			return {
				p: t,
				q: r,
				said: `${e.joint} is open by ${i(Math.hypot(...e.p.map((t, n) => t - e.q[n])) / u, 3)} ${l}`
			};
		}), f = JSON.stringify(o);
		if (f !== d) {
			d = f, c.replaceChildren();
			for (let { p: n, q: i, said: s } of o) {
				t("path", c, {
					class: "l-gap",
					d: a([n, i]),
					style: "fill:none"
				});
				let [o, l] = [i[0] - n[0], i[1] - n[1]], u = Math.hypot(o, l) || 1, d = l < 0 ? -1 : 1;
				e(p(c, "gap", s, 3.3, "start"), {
					x: r((n[0] + i[0]) / 2 + d * 4 * l / u + 2),
					y: r((n[1] + i[1]) / 2 - d * 4 * o / u + 1)
				});
			}
		}
	};
}
// src/material.ts
var _ = class {
	links;
	poses;
	source;
	constructor(e, t, n) {
		this.links = e, this.poses = t, this.source = n;
	}
	axes(e, t) {
		let n = this.poses[e].map(t), r = n.length === 12 ? 3 : 2;
		return {
			at: n.slice(0, r),
			axes: Array.from({ length: r }, (e, t) => n.slice(r + r * t, r + r * t + r))
		};
	}
	place(e, t, n = (e) => this.source.here[e]) {
		let { at: r, axes: i } = this.axes(e, n);
		return r.map((e, n) => i.reduce((e, r, i) => e + (t[i] ?? 0) * r[n], e));
	}
	on(e, t, n, r) {
		return e.of(...e.project(this.place(t, n, (e) => this.source.value(e, r))));
	}
	local(e, t, [n, r]) {
		let { at: i, axes: a } = this.axes(t, (e) => this.source.here[e]), [o, s] = e.of(...e.project(i)), c = e.vector([n - o, r - s]);
		return a.map((e) => e.reduce((e, t, n) => e + t * c[n], 0));
	}
}, v = 1e-9, y = 1e-12, b = .25, x = 1e-13, S = 1e-9, C = 1e5, w = 1e3, T = .05, E = 1e-5, D = (e) => ({
	point: e.point.slice(),
	rotation: e.rotation.slice(),
	turn: e.turn.slice()
}), O = class {
	data;
	program;
	hold;
	active;
	weight;
	missing;
	byRow;
	place;
	first;
	start;
	matrix;
	right;
	inputs;
	n;
	size;
	constructor(e, t) {
		this.data = e, this.program = t;
		let n = this.n = e.dimension === 2 ? 3 : 6, r = e.rows;
		this.size = n * e.links.length, this.place = e.links.map((t, n) => e.order.indexOf(n)), this.hold = new Float64Array(r.length), this.missing = new Float64Array(r.length), this.weight = new Float64Array(r.length).fill(1), this.active = Uint8Array.from(r, (t, n) => +(t.kind !== "freedom" || e.drives.includes(n))), this.inputs = t.module.channels.map((e) => {
			let [, t, n] = e.split(" ");
			return [t, +n];
		}), this.byRow = r.map(() => []);
		for (let t = 0; t < e.entries.length; t += 3) {
			let [i, a, o] = e.entries.slice(t, t + 3), s = a % n, c = (a - s) / n, l = (s < e.dimension ? e.length : 1) * (r[i].angular ? 1 : 1 / e.length);
			this.byRow[i].push([
				n * this.place[c] + s,
				o,
				l
			]);
		}
		for (let e of this.byRow) e.sort((e, t) => e[0] - t[0]);
		[this.first, this.start] = this.profile(), this.matrix = new Float64Array(this.start[this.size]), this.right = new Float64Array(this.size);
	}
	profile() {
		let e = Int32Array.from({ length: this.size }, (e, t) => t - t % this.n), t = new Int32Array(this.size + 1);
		for (let t of this.byRow) for (let [n] of t) e[n] = Math.min(e[n], t[0][0]);
		for (let n = 0; n < this.size; n++) t[n + 1] = t[n] + n - e[n] + 1;
		return [e, t];
	}
	set values(e) {
		this.program.values.set(e);
	}
	count(e, t) {
		for (let n of e) this.active[n] = +t;
	}
	evaluate(e) {
		this.inputs.forEach(([t, n], r) => this.program.put(r, e[t][n])), this.program.call(1);
	}
	gap(e) {
		this.evaluate(e);
		let t = 0;
		return this.data.rows.forEach((e, n) => {
			let r = this.hold[n] - this.program.at(e.value);
			e.period !== void 0 && (r -= this.program.at(e.period) * Math.round(r / this.program.at(e.period))), this.missing[n] = e.angular ? r : r / this.data.length, this.active[n] && (t = Number.isFinite(r) ? Math.max(t, Math.abs(this.missing[n])) : Infinity);
		}), t;
	}
	misses(e, t) {
		return this.drive(t), this.gap(e), this.missing;
	}
	measure(e, t) {
		return this.evaluate(t), this.program.at(this.data.rows[e].value);
	}
	gaps(e) {
		let t = /* @__PURE__ */ new Map();
		return this.gap(e), this.data.rows.forEach((e, n) => {
			e.kind === "constraint" && !e.angular && t.set(e.joint, Math.hypot(t.get(e.joint) ?? 0, this.missing[n] * this.data.length));
		}), t;
	}
	solve(e) {
		return this.fill(e), this.answer();
	}
	fill(e) {
		let { matrix: t, right: n, first: r, start: i, size: a, program: o } = this;
		t.fill(0), n.fill(0);
		for (let n = 0; n < a; n++) t[i[n] + n - r[n]] = e;
		this.byRow.forEach((e, a) => {
			if (!this.active[a]) return;
			let s = this.weight[a];
			for (let c = 0; c < e.length; c++) {
				let [l, u, d] = e[c], f = s * d * o.at(u);
				n[l] += f * this.missing[a];
				for (let n = 0; n <= c; n++) t[i[l] + e[n][0] - r[l]] += f * e[n][2] * o.at(e[n][1]);
			}
		});
	}
	answer() {
		this.cholesky();
		let e = 0;
		for (let t of this.right) e = Math.max(e, Math.abs(t));
		return Number.isFinite(e) ? e : Infinity;
	}
	cholesky() {
		let { matrix: e, right: t, first: n, start: r, size: i } = this;
		for (let a = 0; a < i; a++) {
			let i = n[a], o = r[a] - i;
			for (let t = i; t <= a; t++) {
				let s = n[t], c = r[t] - s, l = e[o + t];
				for (let n = Math.max(i, s); n < t; n++) l -= e[o + n] * e[c + n];
				e[o + t] = a === t ? Math.sqrt(Math.max(l, 1e-30)) : l / e[c + t];
			}
			let s = t[a];
			for (let n = i; n < a; n++) s -= e[o + n] * t[n];
			t[a] = s / e[o + a];
		}
		for (let a = i - 1; a >= 0; a--) {
			let i = r[a] - n[a], o = t[a] /= e[i + a];
			for (let r = n[a]; r < a; r++) t[r] -= e[i + r] * o;
		}
	}
	moved(e, t) {
		let { n, data: r, right: i } = this, a = r.dimension, o = D(e);
		return r.links.forEach((e, s) => {
			let c = n * this.place[s];
			for (let e = 0; e < a; e++) o.point[a * s + e] += t * r.length * i[c + e];
			a === 2 ? (o.turn[s] += t * i[c + 2], o.rotation[2 * s] = Math.cos(o.turn[s]), o.rotation[2 * s + 1] = Math.sin(o.turn[s])) : j(o.rotation, 9 * s, t * i[c + 3], t * i[c + 4], t * i[c + 5]);
		}), r.turns.length && (this.evaluate(o), r.turns.forEach((e, t) => o.turn[t] = this.program.at(e))), o;
	}
	correct(e, t = Infinity, n = 12, r = S) {
		let i = this.gap(e), a = 0, o = 0;
		for (let s = 0; s < n; s++) {
			if (i <= y) return {
				pose: e,
				first: a,
				rest: o
			};
			if (!Number.isFinite(i)) return null;
			let n = this.solve(r);
			if (s ? o += n : a = n, !(a + o <= t)) return null;
			let c = this.moved(e, Math.min(1, b / n)), l = this.gap(c);
			if (l <= 1e-9 && l > .5 * i) return {
				pose: l < i ? c : e,
				first: a,
				rest: o
			};
			[e, i] = [c, l];
		}
		return i <= 1e-9 ? {
			pose: e,
			first: a,
			rest: o
		} : null;
	}
	apart(e, t) {
		let n = 0;
		e.point.forEach((e, r) => n = Math.max(n, Math.abs(e - t.point[r]) / this.data.length));
		let [r, i] = this.data.dimension === 2 ? [e.turn, t.turn] : [e.rotation, t.rotation];
		return r.forEach((e, t) => n = Math.max(n, Math.abs(e - i[t]))), n;
	}
	drive(e) {
		this.data.drives.forEach((t, n) => this.hold[t] = e[n]);
	}
	close(e, t, n = Infinity) {
		return this.drive(t), this.correct(e, n, 40)?.pose ?? null;
	}
	walk(e, t) {
		let n = e.drives, r = Math.max(...t.map((e, t) => Math.abs(e - n[t])), 0);
		if (r === 0) return e.pose;
		let i = 1, a = 0;
		for (; a < 1;) {
			let o = a + i > 1 - 1e-12 ? 1 : a + i, s = t.map((e, t) => o === 1 ? e : n[t] + o * (e - n[t])), c = this.stride(e, s, (o - a) * r);
			if (c) e.add(c, s, (o - a) * r), a = o, i = Math.min(1, 2 * i);
			else if ((i /= 2) < 2 ** -14) return null;
		}
		return e.pose;
	}
	stride(e, t, n) {
		this.drive(t);
		let r = this.data.dimension === 2 ? e.ahead(n) : null;
		if (r) {
			let t = this.correct(r, .5, 12, x), n = this.apart(r, e.pose);
			if (t && t.first + t.rest <= .1 * n + 1e-7) return t.pose;
		}
		let i = this.correct(e.pose, .6, 10, e.stations > 1 ? x : S);
		return i && i.first <= .5 && i.rest <= .15 * i.first + 1e-9 && !(r && i.first > 3 * this.apart(r, e.pose) + 1e-6) ? i.pose : null;
	}
	loosen(e, t, n) {
		return this.least(e, t, (e) => e.joint === n && e.kind === "constraint" ? 1 : C, 60);
	}
	open(e, t) {
		let { n, right: r, data: i } = this, a = i.dimension, o = /* @__PURE__ */ new Map();
		r.fill(0), i.links.forEach((e, t) => {
			for (let e = a; e < n; e++) r[n * this.place[t] + e] = T * Math.cos(t * (n - a) + e - a);
		});
		let s = this.least(this.moved(e, 1), t, (e) => e.kind === "freedom" ? w * w : 1, 300, Infinity, 1);
		return this.gap(s), i.rows.forEach((e, t) => {
			if (e.kind === "freedom" || !e.joint) return;
			let [n, r] = o.get(e.joint) ?? [0, 0], a = this.missing[t];
			o.set(e.joint, e.angular ? [n, Math.hypot(r, a)] : [Math.hypot(n, a * i.length), r]);
		}), {
			pose: s,
			gaps: [...o].map(([e, [t, n]]) => ({
				joint: e,
				length: t,
				angle: n
			}))
		};
	}
	mobility(e) {
		let { data: t, size: n, n: r } = this, i = (e) => {
			let t = Array(n).fill(0);
			for (let [n, r, i] of this.byRow[e]) t[n] = i * this.program.at(r);
			return t;
		};
		this.evaluate(this.correct(e, Infinity, 60)?.pose ?? e);
		let a = t.rows.map((e, t) => ({
			r: e,
			k: t,
			j: i(t)
		})), o = a.filter(({ r: e }) => e.kind !== "freedom"), s = a.filter(({ k: e }) => t.drives.includes(e)), c = k([...o, ...s].map(({ j: e }) => [...e]), n), l = (e) => c.some((t) => Math.abs(t.reduce((t, n, r) => t + n * e[r], 0)) > 1e-6);
		return {
			freedoms: k(o.map(({ j: e }) => [...e]), n).length,
			links: t.links.filter((e, t) => c.some((e) => e.slice(r * this.place[t], r * this.place[t] + r).some((e) => Math.abs(e) > 1e-6))),
			joints: a.flatMap(({ r: e, j: t }) => e.kind === "freedom" && l(t) ? [e] : [])
		};
	}
	least(e, t, n, r, i = b, a = .001) {
		this.drive(t), this.data.rows.forEach((e, t) => this.weight[t] = n(e));
		let o = () => this.missing.reduce((e, t, n) => e + (this.active[n] ? this.weight[n] * t * t : 0), 0), s = (this.gap(e), o());
		for (let t = 0; t < r && a < 1e8; t++) {
			let t = this.solve(a), n = this.moved(e, Math.min(1, i / t)), r = this.gap(n), c = Number.isFinite(r) ? o() : Infinity;
			if (c < s) {
				let t = s - c < 1e-12 * s;
				if ([e, s, a] = [
					n,
					c,
					Math.max(a / 4, 1e-9)
				], t) break;
			} else a *= 8, this.gap(e);
		}
		return this.weight.fill(1), e;
	}
};
function k(e, t) {
	let n = Array.from({ length: t }, (e, t) => t), r = [], i = Math.max(0, ...e.flat().map(Math.abs));
	for (let a = 0; a < Math.min(e.length, t); a++) {
		let o = 0, s = a, c = a;
		for (let r = a; r < e.length; r++) for (let i = a; i < t; i++) Math.abs(e[r][n[i]]) > o && ([o, s, c] = [
			Math.abs(e[r][n[i]]),
			r,
			i
		]);
		if (!(o > E * i)) break;
		[e[a], e[s]] = [e[s], e[a]], [n[a], n[c]] = [n[c], n[a]];
		let l = n[a], u = e[a][l];
		e[a] = e[a].map((e) => e / u);
		for (let t = 0; t < e.length; t++) if (t !== a && e[t][l] !== 0) {
			let n = e[t][l];
			e[t] = e[t].map((t, r) => t - n * e[a][r]);
		}
		r.push(l);
	}
	return n.slice(r.length).map((n) => {
		let i = Array(t).fill(0);
		i[n] = 1, r.forEach((t, r) => i[t] = -e[r][n]);
		let a = Math.max(...i.map(Math.abs));
		return i.map((e) => e / a);
	});
}
var A = class {
	pose;
	drives;
	past = [];
	stations = 1;
	constructor(e, t) {
		this.pose = e, this.drives = t;
	}
	add(e, t, n) {
		this.past = [{
			pose: this.pose,
			back: 0
		}, ...this.past].slice(0, 2).map((e) => ({
			...e,
			back: e.back + n
		})), [this.pose, this.drives] = [e, t], this.stations++;
	}
	ahead(e) {
		let { past: t, pose: n } = this, [r, i] = t;
		if (!r || !(r.back > 0)) return null;
		let a = e, o = r.back, s = i?.back ?? 0, c = i !== void 0 && s > o, l = c ? [
			(a + o) * (a + s) / (o * s),
			a * (a + s) / (o * (o - s)),
			a * (a + o) / (s * (s - o))
		] : [
			1 + a / o,
			-a / o,
			0
		], u = (e) => n[e].map((t, n) => l[0] * t + l[1] * r.pose[e][n] + (c ? l[2] * i.pose[e][n] : 0)), d = {
			point: u("point"),
			turn: u("turn"),
			rotation: n.rotation.slice()
		};
		return d.turn.forEach((e, t) => [d.rotation[2 * t], d.rotation[2 * t + 1]] = [Math.cos(e), Math.sin(e)]), d;
	}
};
function j(e, t, n, r, i) {
	let a = Math.hypot(n, r, i);
	if (a < 1e-300) return;
	let o = Math.sin(a) / a, s = (1 - Math.cos(a)) / (a * a), c = e.slice(t, t + 9), l = [
		1 - s * (r * r + i * i),
		s * n * r - o * i,
		s * n * i + o * r,
		s * n * r + o * i,
		1 - s * (n * n + i * i),
		s * r * i - o * n,
		s * n * i - o * r,
		s * r * i + o * n,
		1 - s * (n * n + r * r)
	];
	for (let n = 0; n < 3; n++) for (let r = 0; r < 3; r++) e[t + 3 * n + r] = l[3 * n] * c[r] + l[3 * n + 1] * c[3 + r] + l[3 * n + 2] * c[6 + r];
}
// src/motion.ts
var M = 8, N = 120, P = .3, F = 2 ** -7, I = class {
	kernel;
	shown;
	values;
	inputs;
	sketch;
	data;
	poses;
	branches;
	count;
	first;
	held;
	base;
	loose = null;
	seen = null;
	model;
	phases;
	phasesAtFirst;
	weakest;
	driven;
	channels;
	constructor(e, t, n, r, i, a) {
		this.kernel = t, this.shown = r, this.values = i, this.inputs = a;
		let o = this.data = e.sketch;
		this.sketch = new O(o, n), this.count = e.kernel.count, this.driven = Array.from({ length: this.count }, (e, n) => t.drives(n)), this.poses = Array(this.count).fill(null), this.branches = o.branches.map(() => new Float64Array(this.count).fill(1)), this.model = new Float64Array(o.branches.length).fill(1), this.phases = o.rows.flatMap((e, t) => e.kind === "phase" ? [t] : []);
		let [s, c, l] = [
			o.pose.point,
			o.pose.rotation,
			o.pose.turn
		].map((e) => Float64Array.from(e));
		this.first = {
			values: Float64Array.from(e.numbers, (e) => e.value),
			t: o.place,
			pose: {
				point: s,
				rotation: c,
				turn: l
			}
		}, this.sketch.values = this.first.values, this.phasesAtFirst = this.phases.map((e) => this.sketch.measure(e, this.first.pose)), this.held = this.first, this.base = {
			place: o.place,
			pose: this.first.pose
		}, this.weakest = z(o);
		let u = e.drives.map((e) => e.name);
		this.channels = r.module.channels.map((e) => {
			let [t, n, r] = e.split(" "), i = o.branches.indexOf(e);
			return t === "pose" ? {
				kind: t,
				part: n,
				k: +r,
				given: this.values
			} : t === "position" ? {
				kind: t,
				part: "turn",
				k: u.indexOf(e.slice(9)),
				given: this.values
			} : {
				kind: i < 0 ? "given" : "branch",
				part: "turn",
				k: i,
				given: i < 0 ? a(e) : this.values
			};
		}), this.home();
	}
	home() {
		this.hold(this.phasesAtFirst), this.held = this.first, this.base = {
			place: this.first.t,
			pose: this.first.pose
		}, [this.seen, this.loose] = [null, null];
	}
	hold(e) {
		this.phases.forEach((t, n) => this.inputs(`phase ${t}`).fill(this.sketch.hold[t] = e[n]));
	}
	assume(e) {
		if (this.home(), !e) return;
		let t = B(this.data, this.held.pose, e), { sketch: n } = this;
		n.values = this.values, n.count(this.phases, !1);
		for (let e of [...this.data.places, ...Array(this.count).keys()]) {
			let r = this.wound(t, this.kernel.drives(e)), i = n.close(r, this.kernel.drives(e));
			if (!(!i || this.turned(i, r) > 1e-6)) {
				this.held = {
					values: this.values.slice(),
					t: e,
					pose: i
				}, this.hold(this.phases.map((e) => n.measure(e, i)));
				break;
			}
		}
		n.count(this.phases, !0);
	}
	turned(e, t) {
		let [n, r] = this.data.dimension === 2 ? [e.turn, t.turn] : [e.rotation, t.rotation];
		return n.reduce((e, t, n) => Math.max(e, Math.abs(t - r[n])), 0);
	}
	update() {
		if (this.seen?.every((e, t) => e === this.values[t])) return !1;
		this.seen = this.values.slice();
		let e = this.reclose();
		return this.poses.fill(null), e && this.follow(this.held.t, this.held.pose), this.settle(e), !0;
	}
	reclose() {
		let e = this.values, t = this.kernel.drives(this.held.t), { sketch: n } = this;
		if (this.loose) {
			n.values = e;
			let t = n.close(this.loose.pose, this.kernel.drives(this.loose.t), P);
			if (t && (this.held = {
				values: e.slice(),
				t: this.loose.t,
				pose: t
			}), this.loose = null, t) return !0;
		}
		let r = this.held.values, i = 1, a = 0;
		for (; a < 1;) {
			let o = Math.min(1, a + i), s = e.map((e, t) => o === 1 ? e : r[t] + o * (e - r[t]));
			n.values = s;
			let c = n.close(this.held.pose, t, P);
			if (c) this.held = {
				values: s,
				t: this.held.t,
				pose: c
			}, [a, i] = [o, Math.min(1, 2 * i)];
			else if ((i /= 2) < F) return !1;
		}
		return !0;
	}
	follow(e, t) {
		let { course: n, cycle: r } = this.data, i = this.count;
		this.sketch.values = this.values;
		let a = this.along(e), o = this.kernel.drives(e), [s, c] = [Math.ceil(a), Math.floor(a)].map((e, n) => this.march(new A(t, o), e, n ? -1 : 1, null));
		r && !this.phases.length && (s && this.poses[n[i - 1]] && this.march(s, 0, 1, r), c && this.poses[n[0]] && this.march(c, i - 1, -1, r));
	}
	along(e) {
		let { course: t } = this.data;
		if (Number.isInteger(e) && e < this.count) return t.indexOf(e);
		let n = t.every((e, t) => e === t), r = this.kernel.drives(e)[0];
		return (n ? Math.ceil(e) : t.findIndex((e) => this.kernel.drives(e)[0] > r)) - .5;
	}
	march(e, t, n, r) {
		let { course: i } = this.data, a = this.count, o = this.data.dimension === 2 ? Math.ceil(a / N) : 1, s = (r ?? []).map((e) => n * (r.length > 1 ? e : Math.abs(e))), c = this.counts((e) => s[this.data.drives.indexOf(e)] ?? 0), l = (e) => this.kernel.drives(i[e]).map((e, t) => e + (s[t] ?? 0)), u = (e, t) => {
			r ? this.poses[i[e]] = {
				point: t.point,
				rotation: t.rotation,
				turn: t.turn.map((e, t) => e - c[t])
			} : this.poses[i[e]] = t;
		};
		for (let s = t; s >= 0 && s < a;) {
			if (r && this.poses[i[s]]) return null;
			let t = e.pose, c = e.drives, d = Math.min(Math.max(s + n * (o - 1), 0), a - 1);
			if (d !== s && !this.sketch.walk(e, l(d)) && (e = new A(t, c), d = s), d === s && !this.sketch.walk(e, l(s))) return null;
			for (let r = s; r !== d; r += n) u(r, new R(t, e.pose, c, e.drives, l(r)));
			u(d, e.pose), s = d + n;
		}
		return e;
	}
	counts(e) {
		let { data: t } = this, n = new Float64Array(this.held.pose.turn.length), r = /* @__PURE__ */ new Set([t.links.length]);
		if (t.dimension !== 2) return n;
		let i = new Set(t.rows.flatMap((e, n) => e.angular && (e.kind === "constraint" || t.drives.includes(n)) ? [n] : []));
		for (; i.size;) {
			let a = [...i].find((e) => t.rows[e].ends.some((e) => r.has(e)));
			if (a === void 0) {
				r.add(t.rows[[...i][0]].ends[0]);
				continue;
			}
			let [o, s] = t.rows[a].ends;
			r.has(s) ? r.has(o) || (n[o] = (n[s] ?? 0) - e(a)) : n[s] = (n[o] ?? 0) + e(a), r.add(o).add(s), i.delete(a);
		}
		return n;
	}
	settle(e) {
		let { t, pose: n } = e ? this.held : {
			t: this.base.place,
			pose: this.base.pose
		};
		this.spread(this.read(n, t));
		let r = this.kernel.closes(), i = this.firstOf(r), a = i < 0 ? null : this.poses[i] ?? this.enter(i, n);
		if (a) {
			if (this.poses[i] || this.follow(i, a), this.base = {
				place: i,
				pose: this.exact(i) ?? a
			}, this.poses.every((e) => e)) {
				this.model = this.read(a, i);
				return;
			}
			this.spread(this.read(a, i)), r = this.kernel.closes(), this.behind(r);
		}
		this.spread(this.model), this.kernel.closes();
	}
	exact(e) {
		return this.sketch.values = this.values, this.poses[e] && this.sketch.close(this.poses[e], this.kernel.drives(e), .05);
	}
	firstOf(e) {
		let t = (t) => this.poses[t] !== null || e[t] > 0;
		return this.data.places.find(t) ?? e.findIndex((e, n) => t(n));
	}
	enter(e, t) {
		let n = this.data.dimension, r = D(t), i = .1;
		return this.kernel.posed(e).forEach((e, t) => {
			if (!e.every(Number.isFinite)) i = Infinity;
			else {
				for (let i = 0; i < n; i++) r.point[n * t + i] = e[i];
				if (n === 2) r.turn[t] += L(Math.atan2(e[3], e[2]) - r.turn[t]), [r.rotation[2 * t], r.rotation[2 * t + 1]] = [e[2], e[3]];
				else for (let n = 0; n < 3; n++) for (let i = 0; i < 3; i++) r.rotation[9 * t + 3 * n + i] = e[3 + 3 * i + n];
			}
		}), [
			...r.point,
			...r.rotation,
			...r.turn
		].every(Number.isFinite) ? (this.sketch.values = this.values, this.sketch.close(this.wound(r, this.kernel.drives(e)), this.kernel.drives(e), i)) : null;
	}
	wound(e, t) {
		let { data: n, sketch: r } = this, i = (e) => 2 * Math.PI * Math.round(e / (2 * Math.PI)), a = n.drives.map((a, o) => n.rows[a].angular ? i(t[o] - r.measure(a, e)) : 0), o = this.counts((e) => a[this.data.drives.indexOf(e)] ?? 0);
		return {
			...e,
			turn: e.turn.map((e, t) => e + o[t])
		};
	}
	behind(e) {
		let { course: t } = this.data, n = (e) => this.poses[t[e]] !== null;
		for (let r = 0; r < this.count; r++) {
			if (n(r) || !e[t[r]]) continue;
			let i = r;
			for (; i + 1 < this.count && !n(i + 1) && e[t[i + 1]] && !this.gapBetween(i);) i++;
			let a = r === 0 || !e[t[r - 1]] && !n(r - 1) || this.gapBetween(r - 1), o = i === this.count - 1 || !n(i + 1) || this.gapBetween(i);
			if (a && o) {
				let e = t[r + i >> 1], n = this.enter(e, this.base.pose);
				n && this.follow(e, n);
			}
			r = i;
		}
	}
	gapBetween(e) {
		let [t, n] = [this.data.course[e], this.data.course[e + 1]];
		for (let e = 1; e < M; e++) if (!this.kernel.closesAt(t + e / M * (n - t))) return !0;
		return !1;
	}
	read(e, t) {
		let n = new Float64Array(this.branches.length).fill(1);
		for (let r = 0; r < n.length; r++) n[r] = this.look(e, t, n).at(r) < 0 ? -1 : 1;
		return n;
	}
	look(e, t, n) {
		let r = this.shown, i = this.kernel.drives(t);
		return r.values.set(this.values), this.channels.forEach((t, a) => r.put(a, t.kind === "pose" ? e[t.part][t.k] : t.kind === "position" ? i[t.k] : t.kind === "branch" ? n[t.k] : t.given[0])), r.call(1), r;
	}
	get otherwise() {
		return this.model;
	}
	spread(e) {
		let t = this.shown, { row: n } = t, r = this.count, i = this.base.pose;
		this.model = e, t.values.set(this.values);
		let a = this.poses.map((e) => e ?? i), { path: o } = t;
		this.channels.forEach(({ kind: e, part: t, k: i, given: s }, c) => {
			let l = c * n;
			if (e === "pose") for (let e = 0; e < r; e++) {
				let n = a[e];
				o[l + e] = n instanceof R ? n.value(t, i) : n[t][i];
			}
			else if (e === "position") for (let e = 0; e < r; e++) o[l + e] = this.driven[e][i];
			else e === "given" && o.set(s.subarray(0, r), l);
		});
		for (let i = !0, a = this.branches.length + 1; i && a; a--) this.channels.forEach((e, r) => e.kind === "branch" && t.path.set(this.branches[e.k], r * n)), t.call(r), i = !1, this.branches.forEach((n, a) => {
			for (let o = 0; o < r; o++) {
				let r = this.poses[o] ? t.at(a, o) < 0 ? -1 : 1 : e[a];
				i ||= r !== n[o], n[o] = r;
			}
		});
		this.branches.forEach((e, t) => this.inputs(this.data.branches[t]).set(e)), this.data.known.forEach((e, n) => {
			let i = this.inputs(e);
			for (let e = 0; e < r; e++) i[e] = this.poses[e] ? t.at(this.branches.length + n, e) : NaN;
		});
	}
	at(e) {
		this.update();
		let t = Math.floor(e) % this.count, n = e - Math.floor(e) === 0 && this.count <= N ? this.poses[t] : null;
		this.sketch.values = this.values;
		for (let r of [t, (t + 1) % this.count]) {
			let t = this.poses[r];
			if (n || !t) continue;
			let i = this.sketch.close(t, this.kernel.drives(r), .05), a = this.nearDrives(r, e);
			n = i && this.sketch.walk(new A(i, this.kernel.drives(r)), a);
		}
		return n && ([this.held, this.loose] = [{
			values: this.values.slice(),
			t: e,
			pose: n
		}, null]), n;
	}
	nearDrives(e, t) {
		let n = this.kernel.drives(t), r = this.kernel.drives(e);
		return n.map((e, t) => this.data.cycle?.[t] ? r[t] + L(e - r[t]) : e);
	}
	stretched(e) {
		this.sketch.values = this.values;
		let t = this.loose?.t === e ? this.loose.pose : this.nearest(e);
		return this.loose = {
			t: e,
			pose: this.sketch.loosen(t, this.kernel.drives(e), this.weakest)
		}, this.loose.pose;
	}
	open(e) {
		return this.sketch.values = this.values, this.sketch.open(this.nearest(e), this.kernel.drives(e));
	}
	nearest(e) {
		let t = this.held.pose, n = Infinity;
		return this.poses.forEach((r, i) => {
			r && Math.abs(i - e) < n && ([t, n] = [r, Math.abs(i - e)]);
		}), t;
	}
	assembly() {
		this.update();
		let { links: e, dimension: t, counted: n } = this.data, { pose: r } = this.base;
		return e.flatMap((e, i) => t === 2 ? [r.turn[i] + (n[e] ?? 0)] : [...r.point.subarray(3 * i, 3 * i + 3), ...te(r.rotation.subarray(9 * i, 9 * i + 9))]);
	}
	placed() {
		let { links: e, dimension: t } = this.data, { pose: n } = this.held;
		return Object.fromEntries(e.map((e, r) => [e, t === 2 ? [
			n.point[2 * r],
			n.point[2 * r + 1],
			n.turn[r]
		] : [...n.point.subarray(3 * r, 3 * r + 3), ...n.rotation.subarray(9 * r, 9 * r + 9)]]));
	}
	take(e) {
		let { data: t, sketch: n, kernel: r } = this, i = V(t, this.first.pose, e);
		this.home(), n.values = this.values, n.count(this.phases, !1);
		let a = ((e) => t.drives.map((t) => n.measure(t, e)))(i), o = n.close(i, a, P), s = o && this.placeOf(a);
		if (o && s !== null) {
			let e = r.drives(s).map((e, n) => t.rows[t.drives[n]].angular ? a[n] + L(e - a[n]) : e);
			o = n.walk(new A(o, a), e), o &&= this.wound(o, r.drives(s));
		}
		return o && s !== null && (this.held = {
			values: this.values.slice(),
			t: s,
			pose: o
		}, this.hold(this.phases.map((e) => n.measure(e, o)))), n.count(this.phases, !0), o && s !== null ? s : null;
	}
	placeOf(e) {
		let { kernel: t, data: n, count: r } = this, i = n.drives.map((e) => n.rows[e].angular), a = (r) => Math.hypot(...t.drives(r).map((t, r) => i[r] ? L(t - e[r]) : (t - e[r]) / n.length)), o = 0, s = Infinity;
		for (let e = 0; e < r; e++) a(e) < s && ([o, s] = [e, a(e)]);
		if (e.length !== 1 || s < 1e-12 || t.stepped) return o;
		for (let [n, a] of [
			[o - 1, o],
			[o, o + 1],
			...o === 0 ? [[r - 1, r]] : []
		]) {
			if (n < 0 || a > t.end) continue;
			let [r, o] = [n, a].map((e) => t.drives(e)[0]), s = i[0] ? L : (e) => e, c = s(e[0] - r) / s(o - r);
			if (c >= 0 && c <= 1) return n + c;
		}
		return o;
	}
	state() {
		this.update();
		let { t: e, pose: t } = this.held;
		return [
			e,
			...t.point,
			...t.rotation,
			...t.turn,
			...this.phases.map((e) => this.sketch.hold[e])
		];
	}
	restore(e) {
		let [t, ...n] = e, r = D(this.held.pose);
		for (let e of [
			"point",
			"rotation",
			"turn"
		]) r[e].set(n.splice(0, r[e].length));
		this.hold(n), this.held = {
			values: this.values.slice(),
			t,
			pose: r
		}, [this.seen, this.loose] = [null, null];
	}
}, L = (e) => e - 2 * Math.PI * Math.round(e / (2 * Math.PI)), R = class {
	a;
	b;
	part;
	constructor(e, t, n, r, i) {
		this.a = e, this.b = t;
		let a = r.findIndex((e, t) => e !== n[t]);
		this.part = a < 0 ? 1 : (i[a] - n[a]) / (r[a] - n[a]);
	}
	value(e, t) {
		if (e !== "rotation") return this.a[e][t] + this.part * (this.b[e][t] - this.a[e][t]);
		let n = this.value("turn", t >> 1);
		return t & 1 ? Math.sin(n) : Math.cos(n);
	}
	all(e) {
		return this.a[e].map((t, n) => this.value(e, n));
	}
	get point() {
		return this.all("point");
	}
	get rotation() {
		return this.all("rotation");
	}
	get turn() {
		return this.all("turn");
	}
};
function z(e) {
	let t = (t) => t.ends.filter((t) => t < e.links.length), n = new Set(e.drives.flatMap((n) => t(e.rows[n]))), r = (r) => {
		let i = t(e.rows.find((e) => e.kind === "constraint" && e.joint === r) ?? { ends: [] });
		return i.length - (i.some((e) => n.has(e)) ? .5 : 0);
	};
	return e.gaps.map((e) => e.joint).reduce((e, t) => e && r(e) >= r(t) ? e : t, "");
}
function B(e, t, n) {
	let r = D(t);
	return e.links.forEach((t, i) => {
		if (e.dimension === 2) {
			let a = r.turn[i] = n[i] - (e.counted[t] ?? 0);
			[r.rotation[2 * i], r.rotation[2 * i + 1]] = [Math.cos(a), Math.sin(a)];
			return;
		}
		let [a, o, s, c, l, u, d] = n.slice(7 * i, 7 * i + 7), f = Math.hypot(c, l, u) || 1;
		r.point.set([
			a,
			o,
			s
		], 3 * i), r.rotation.set(ee([
			c / f,
			l / f,
			u / f
		], d), 9 * i);
	}), r;
}
function V(e, t, n) {
	let r = D(t);
	return e.links.forEach((t, i) => {
		let a = n[t], o = e.dimension;
		if (a?.length === (o === 2 ? 3 : 12) && a.every(Number.isFinite)) {
			if (r.point.set(a.slice(0, o), o * i), o === 3) return r.rotation.set(a.slice(3), 9 * i);
			r.turn[i] = a[2], r.rotation.set([Math.cos(a[2]), Math.sin(a[2])], 2 * i);
		}
	}), r;
}
function ee([e, t, n], r) {
	let i = Math.cos(r), a = Math.sin(r), o = 1 - i;
	return [
		i + o * e * e,
		o * e * t - a * n,
		o * e * n + a * t,
		o * e * t + a * n,
		i + o * t * t,
		o * t * n - a * e,
		o * e * n - a * t,
		o * t * n + a * e,
		i + o * n * n
	];
}
function te(e) {
	let t = [
		e[7] - e[5],
		e[2] - e[6],
		e[3] - e[1]
	], n = Math.hypot(...t), r = e[0] + e[4] + e[8] - 1;
	if (n > 1e-6) return [...t.map((e) => e / n), Math.atan2(n, r)];
	if (r > 0) return [
		0,
		0,
		1,
		0
	];
	let i = [
		0,
		1,
		2
	].reduce((t, n) => e[4 * n] > e[4 * t] ? n : t), a = [
		0,
		1,
		2
	].map((t) => e[3 * t + i] + +(t === i)), o = Math.hypot(...a);
	return [...a.map((e) => e / o), Math.PI];
}
// src/program.ts
function H(e) {
	return Uint8Array.from(atob(e), (e) => e.charCodeAt(0));
}
function U(e) {
	if (typeof e == "string") return new Float64Array(H(e).buffer);
	let t = (e.to - e.from) / Math.max(e.count - 1, 1);
	return Float64Array.from({ length: e.count }, (n, r) => r === e.count - 1 ? e.to : e.from + r * t);
}
async function ne(e) {
	let t = new Blob([H(e)]).stream().pipeThrough(new DecompressionStream("deflate"));
	return new Response(t).arrayBuffer();
}
var W = class e {
	run;
	module;
	values;
	path;
	out;
	row;
	places = [];
	constructor(e, t, n, r) {
		this.run = e, this.module = n, this.row = n.row;
		let i = [
			r,
			n.channels.length * n.row,
			(n.outputs + 1) * n.row
		], a = n.heap;
		for (let e of i) this.places.push(a), a = a + 8 * e + 15 & -16;
		a > t.buffer.byteLength && t.grow(Math.ceil((a - t.buffer.byteLength) / 65536)), [this.values, this.path, this.out] = i.map((e, n) => new Float64Array(t.buffer, this.places[n], e));
	}
	static async create(t, n) {
		let { instance: r } = await WebAssembly.instantiate(await ne(t.wasm)), { memory: i, run: a } = r.exports;
		return new e(a, i, t, n);
	}
	call(e) {
		this.run(this.places[0], this.places[1], this.places[2], Math.ceil(e / 2));
	}
	put(e, t, n = t) {
		this.path[e * this.row] = t, this.path[e * this.row + 1] = n;
	}
	at(e, t = 0) {
		return this.out[e * this.row + t];
	}
}, re = {
	joint: 0,
	point: 0,
	tracer: 0,
	center: 1,
	load: 1,
	direction: 1,
	link: 4,
	trace: 5
}, G = (e) => {
	let t = e.indexOf(":");
	return {
		kind: e.slice(0, t),
		name: e.slice(t + 1)
	};
}, ie = (e, t) => !!e && !!t && e.kind === t.kind && e.name === t.name;
function K(e, t, n, r = 6) {
	let i = e.getRootNode(), a = /* @__PURE__ */ new Map();
	return [
		0,
		.5,
		1
	].forEach((o, s) => {
		for (let c = 0; c < (s ? 8 : 1); c++) {
			let l = c * Math.PI / 4;
			for (let c of i.elementsFromPoint(t + o * r * Math.cos(l), n + o * r * Math.sin(l))) {
				let t = e.contains(c) && c.closest("[data-item]")?.dataset.item;
				t && !a.has(t) && a.set(t, 2 * s + (re[G(t).kind] ?? 2));
			}
		}
	}), [...a].sort((e, t) => e[1] - t[1]).map(([e]) => G(e));
}
function ae(e, t) {
	e.querySelectorAll(".chosen").forEach((e) => e.classList.remove("chosen")), t && e.querySelectorAll(`[data-item="${CSS.escape(`${t.kind}:${t.name}`)}"]`).forEach((e) => e.classList.add("chosen"));
}
// src/pull.ts
var q = 1 / 10;
function oe(e, t) {
	if (!t) return -1;
	let { kind: n, name: r } = G(t), { links: i, rows: a } = e.sketch;
	return n === "link" || n === "center" ? i.indexOf(r) : (n === "joint" ? a.find((e) => e.joint === r)?.ends : void 0)?.find((e) => e < i.length) ?? -1;
}
function se(e, t, n) {
	for (let { kind: r, name: i } of K(e, t.clientX, t.clientY, t.pointerType === "touch" ? 14 : 6)) {
		let e = n(`${r}:${i}`);
		if (e >= 0) return e;
	}
	return -1;
}
function ce(e, t, n, r, i) {
	if (n.count < 2) return;
	let a = -1, o = [];
	e.svg.addEventListener("pointerdown", (n) => {
		a = n.button === 0 ? se(e.svg, n, (e) => oe(t, e)) : -1, a < 0 || (e.svg.setPointerCapture(n.pointerId), o = r.local(e.paper, a, s(e.svg, n)));
	}), e.svg.addEventListener("pointermove", (t) => {
		a >= 0 && e.svg.hasPointerCapture(t.pointerId) && i.seek(l(s(e.svg, t)));
	});
	let c = () => void (a = -1);
	e.svg.addEventListener("pointerup", c), e.svg.addEventListener("pointercancel", c);
	function l(t) {
		let { count: s, cyclic: c } = n, l = i.time(), u = Math.max(3, Math.ceil(s * q)), d = l, f = Infinity, p = /* @__PURE__ */ new Map(), m = (t) => (p.has(t) || p.set(t, n.motion.poses[t] ? r.on(e.paper, a, o, t) : null), p.get(t));
		for (let e = Math.floor(l) - u; e <= Math.floor(l) + u; e++) {
			if (!c && (e < 0 || e + 1 >= s)) continue;
			let [n, r] = [e, e + 1].map((e) => (e % s + s) % s), [i, a] = [m(n), m(r)];
			if (!i || !a) continue;
			let o = [a[0] - i[0], a[1] - i[1]], u = o[0] ** 2 + o[1] ** 2 || 1, p = Math.min(Math.max(((t[0] - i[0]) * o[0] + (t[1] - i[1]) * o[1]) / u, 0), 1), h = Math.hypot(t[0] - i[0] - p * o[0], t[1] - i[1] - p * o[1]) + .001 * Math.abs(e + p - l);
			h < f && ([d, f] = [e + p, h]);
		}
		return c ? (d % s + s) % s : d;
	}
}
// src/pulling.ts
var le = 12, ue = 1e6, J = .001, de = 1e-5, Y = 1e6, fe = .5, pe = 6, me = 100, he = .2, ge = class extends O {
	pose;
	closed = !1;
	away = 0;
	damping = J;
	constructor(e, t, n) {
		super(e, t), this.pose = n, this.placed(n);
	}
	placed(e) {
		this.data.rows.forEach((t, n) => t.kind === "phase" && (this.hold[n] = this.measure(n, e))), this.pose = e, this.damping = J, this.closed = this.gap(e) <= v;
	}
	lock(e, t) {
		this.active[e] = +t, this.hold[e] = this.measure(e, this.pose);
	}
	locked(e) {
		return this.data.rows[e].kind === "freedom" && this.active[e] > 0;
	}
	at({ link: e, u: t }, n = this.pose) {
		let r = this.data.dimension, i = n.point.subarray(r * e, r * e + r);
		if (r === 2) {
			let [r, a] = n.rotation.subarray(2 * e, 2 * e + 2);
			return [i[0] + r * t[0] - a * t[1], i[1] + a * t[0] + r * t[1]];
		}
		let a = n.rotation.subarray(9 * e, 9 * e + 9);
		return [
			0,
			1,
			2
		].map((e) => i[e] + a[3 * e] * t[0] + a[3 * e + 1] * t[1] + a[3 * e + 2] * t[2]);
	}
	far(e, t, n) {
		return Math.hypot(...this.at(e, n).map((e, n) => t[n] - e)) / this.data.length;
	}
	pull(e, t, n) {
		let { n: r, data: i, matrix: a, right: o, first: s, start: c } = this, l = i.dimension, u = r * this.place[e.link], d = this.at(e, t).map((n, r) => (n - t.point[l * e.link + r]) / i.length);
		for (let e = 0; e < l; e++) {
			let t = Array(r).fill(0), [i, f] = [(e + 1) % 3, (e + 2) % 3];
			t[e] = 1, l === 2 ? t[2] = e ? d[0] : -d[1] : [t[3 + i], t[3 + f]] = [d[f], -d[i]];
			for (let i = 0; i < r; i++) if (t[i]) {
				o[u + i] += t[i] * n[e];
				for (let e = 0; e <= i; e++) a[c[u + i] + u + e - s[u + i]] += t[i] * t[e];
			}
		}
	}
	frame(e, t, n) {
		if (!this.closed) return this.gather(e, t);
		if (!e) return "there";
		this.away = this.far(e, t, this.pose);
		for (let r = 0; r < le; r++) {
			if (this.away < n) return this.ended("there");
			let r = this.step(e, t, n);
			if (!r) return this.ended("nearest");
			let i = this.away - this.far(e, t, r);
			if (this.pose = r, this.away -= i, i < n / 20) return this.ended(this.away < n ? "there" : "nearest");
		}
		return "on the way";
	}
	ended(e) {
		return this.damping = J, e;
	}
	step(e, t, n) {
		let { pose: r, data: i } = this, a = Math.min(1, fe / this.away), o = this.at(e).map((e, n) => a * (t[n] - e) / i.length);
		for (let i = 0; i < pe; i++) {
			this.gap(r), this.weight.fill(ue), this.fill(this.damping), this.weight.fill(1), this.pull(e, r, o);
			let i = this.answer();
			if (!(i >= n / 10)) return null;
			let a = this.correct(this.moved(r, Math.min(1, b / i)), .5 * Math.min(i, b) + 1e-9, 8)?.pose;
			if (a && this.far(e, t, a) < this.away) return this.damping = Math.max(this.damping / 4, de), a;
			this.damping = Math.min(this.damping * 8, Y);
		}
		return null;
	}
	gather(e, t) {
		let n = (n) => {
			let r = this.gap(n), i = this.missing.reduce((e, t, n) => e + (this.active[n] ? me * t * t : 0), 0);
			return Number.isFinite(r) ? i + (e ? this.far(e, t, n) ** 2 : 0) : Infinity;
		}, r = Math.max(this.damping, .01), i = n(this.pose);
		for (let a = 0; a < le && r < 1e8; a++) {
			this.gap(this.pose), this.weight.fill(me), this.fill(r), this.weight.fill(1), e && this.pull(e, this.pose, this.at(e).map((e, n) => (t[n] - e) / this.data.length));
			let a = this.answer(), o = this.moved(this.pose, Math.min(1, b / a)), s = n(o);
			if (!(s < i)) {
				r *= 4;
				continue;
			}
			let c = i - s < 1e-12 * i;
			if ([this.pose, i, r] = [
				o,
				s,
				Math.max(r / 3, 1e-9)
			], c) break;
		}
		this.damping = r;
		let a = this.correct(D(this.pose), he)?.pose;
		return a ? (this.placed(a), "on the way") : "apart";
	}
}, _e = [
	[1, -1],
	[-1, -1],
	[1, 1],
	[-1, 1],
	[0, -1],
	[1, 0],
	[-1, 0],
	[0, 1]
], ve = [
	1,
	1.9,
	3,
	4.5
];
function ye(e, t, n, r) {
	return {
		el: p(e, t, n, r),
		text: n,
		size: r,
		bold: t === "title",
		choice: -1
	};
}
function be(e, t) {
	e.text !== t && (e.text = t, c(e.el, t, e.size));
}
var xe = class {
	bounds;
	texts = [];
	discs = [];
	lines = [];
	constructor(e) {
		this.bounds = e;
	}
	line(e, t) {
		this.lines.push([e, t]);
	}
	disc(e, t) {
		this.discs.push([
			e[0] - t,
			e[1] - t,
			e[0] + t,
			e[1] + t
		]);
	}
	put(e) {
		let t = e.label, n = f(t.text, t.size, t.bold) + .5, r = 1.1 * t.size + (t.text.includes("_") ? .3 * t.size : 0), i = e.leave ?? 1.2, a = e.away && Math.hypot(...e.away) || 1, s = Infinity, c = 0, l = [
			0,
			0,
			0,
			0
		], u = 0;
		for (let [o, d] of e.anchors) for (let f of ve) for (let [p, m] of _e) {
			let h = i * f, g = o + p * (h + n / 2), _ = d + m * (h + r / 2), v = [
				g - n / 2,
				_ - r / 2,
				g + n / 2,
				_ + r / 2
			], y = u % 32 * .12 + .2 * Math.floor(u / 32) - (u === t.choice ? .4 : 0);
			e.away && (y += 1.2 * (1 - (p * e.away[0] + m * e.away[1]) / (Math.hypot(p, m) * a))), y < s && (y += this.cost(v)) < s && (s = y, c = u, l = v), u++;
		}
		t.choice = c, this.texts.push(l), o(t.el, (l[0] + l[2]) / 2, l[1] + .91 * t.size);
	}
	cost(e) {
		let t = 0;
		for (let n of this.texts) Se(e, n) > 0 && (t += 60 + 5 * Se(e, n));
		for (let n of this.discs) Se(e, n) > 0 && (t += 8 + Se(e, n));
		for (let [n, r] of this.lines) Ce(e, n, r) && (t += 6);
		let [n, r, i, a] = this.bounds;
		return (e[0] < n || e[1] < r || e[2] > i || e[3] > a) && (t += 60), t;
	}
};
function Se(e, t) {
	let n = Math.min(e[2], t[2]) - Math.max(e[0], t[0]), r = Math.min(e[3], t[3]) - Math.max(e[1], t[1]);
	return n > 0 && r > 0 ? n * r : 0;
}
function Ce(e, t, n) {
	let r = 0, i = 1, a = [n[0] - t[0], n[1] - t[1]];
	for (let n = 0; n < 2; n++) {
		if (Math.abs(a[n]) < 1e-9) {
			if (t[n] < e[n] || t[n] > e[n + 2]) return !1;
			continue;
		}
		let o = (e[n] - t[n]) / a[n], s = (e[n + 2] - t[n]) / a[n];
		r = Math.max(r, Math.min(o, s)), i = Math.min(i, Math.max(o, s));
	}
	return r < i;
}
// src/items.ts
var we = (e, t, n) => t.reduce((t, r, i) => t + e[i] * n(r), 0), Te = class {
	kernel;
	perMm;
	units;
	camera;
	middle = [0, 0];
	axes = [[1, 0], [0, 1]];
	values = !1;
	constructor(e, t, n, r) {
		this.kernel = e, this.perMm = t, this.units = n, this.camera = r, r && this.turn(0, 0);
	}
	turn(e, t) {
		let n = this.camera;
		n[0] += e, n[1] = Math.min(Math.max(n[1] + t, -1.55), 1.55);
		let r = Math.cos(n[0]), i = Math.sin(n[0]), a = Math.cos(n[1]), o = Math.sin(n[1]);
		this.axes = [
			[
				-i,
				r,
				0
			],
			[
				-o * r,
				-o * i,
				a
			],
			[
				a * r,
				a * i,
				o
			]
		];
	}
	seen(e, t) {
		return e.length < 3 ? [t(e[0]), t(e[1])] : [we(this.axes[0], e, t), we(this.axes[1], e, t)];
	}
	depth(e) {
		return we(this.axes[2], e, (e) => this.kernel.here[e]);
	}
	here(e) {
		return this.seen(e, (e) => this.kernel.here[e]);
	}
	point(e) {
		return this.of(...this.here(e));
	}
	pointAt(e, t) {
		return this.of(...this.seen(e, (e) => this.kernel.value(e, t)));
	}
	of(e, t) {
		return [(e - this.middle[0]) / this.perMm, (this.middle[1] - t) / this.perMm];
	}
	project(e) {
		return this.seen(e.map((e, t) => t), (t) => e[t]);
	}
	vector(e) {
		return this.axes[0].map((t, n) => (e[0] * t - e[1] * this.axes[1][n]) * this.perMm);
	}
	metres(e) {
		return [this.middle[0] + e[0] * this.perMm, this.middle[1] - e[1] * this.perMm];
	}
};
function Ee(e, t, n) {
	let r = De(e, t, n);
	return t.of && (e.lastElementChild.dataset.item = t.of.join(":")), r;
}
function De(n, i, o) {
	let s = o.kernel.here;
	if (i.t === "symbol") {
		let e = t("g", n, i.per_mm ? { class: "span" } : {});
		return e.innerHTML = i.svg, {
			update() {
				let [t, n] = o.point(i.p), a = i.per_mm ? ` scale(${(i.per_mm / o.perMm).toFixed(4)})` : "", c = i.e ? ` rotate(${r(-Math.atan2(s[i.e[1]], s[i.e[0]]) * 180 / Math.PI)})` : "";
				e.setAttribute("transform", `translate(${r(t)} ${r(n)})${c}${a}`);
			},
			mark: (e) => e.disc(o.point(i.p), 1.6)
		};
	}
	if (i.t === "span") {
		let e = t("g", n, { class: "span" });
		return e.innerHTML = i.svg, {
			update() {
				let [[t, n], [a, s]] = i.p.map((e) => o.point(e)), c = Math.hypot(a - t, s - n), l = Math.atan2(s - n, a - t) * 180 / Math.PI;
				e.setAttribute("transform", `translate(${r(t)} ${r(n)}) rotate(${r(l)}) scale(${(c / i.length).toFixed(4)} 1)`);
			},
			mark: (e) => e.line(o.point(i.p[0]), o.point(i.p[1]))
		};
	}
	if (i.t === "circle") {
		let a = t("circle", n, { class: `l-${i.role}` });
		return { update() {
			let [t, n] = o.point(i.p);
			e(a, {
				cx: r(t),
				cy: r(n),
				r: r(Math.abs(s[i.r]) / o.perMm)
			});
		} };
	}
	if (i.t === "pair") return Oe(n, i, o);
	let c = t("path", n, {
		class: `l-${i.role}`,
		style: "fill:none"
	});
	if (i.t === "trace") return { update: () => Pe(c, Fe(o.kernel, (e) => o.pointAt(i.p[0], e), !0)) };
	i.t === "hull" && (c.dataset.link = i.link);
	let l = [], u = !1;
	return {
		update() {
			let e = i.p.map((e) => o.point(e)), t = i.t === "hull" ? h(e) : e;
			u = i.t === "hull" && t.length > 2, l = u ? t : e, i.t === "hull" && c.setAttribute("class", u ? "l-link-area" : "l-link"), c.style.fill = u ? "" : "none", c.setAttribute("d", a(l, u));
		},
		mark(e) {
			l.forEach((t, n) => (n || u) && e.line(l.at(n - 1), t));
		}
	};
}
function Oe(e, n, i) {
	let a = t("g", e), o = n.fixed ? "support" : "block", s = t("path", a, { class: `l-${o}` }), c = t("path", a, { class: `l-${n.shape === "ball" ? o : "pin"}` }), l = n.shape === "block" ? 4.2 : 3.4, u = n.shape === "block" ? 2.2 : 1.7;
	return {
		update() {
			let [e, t] = i.point(n.p), [o, d] = i.here(n.e), f = i.depth(n.e);
			if (a.setAttribute("transform", `translate(${r(e)} ${r(t)}) rotate(${r(-Math.atan2(d, o) * 180 / Math.PI)})`), n.shape === "ball") return s.setAttribute("d", `M${u} 0A${u} ${u} 0 1 0 ${-u} 0A${u} ${u} 0 1 0 ${u} 0Z`);
			let p = l * Math.hypot(o, d), m = u * Math.abs(f), h = f >= 0 ? p : -p;
			n.shape === "round" ? (s.setAttribute("d", `M${r(-p)} ${-u}L${r(p)} ${-u}A${r(m)} ${u} 0 0 1 ${r(p)} ${u}L${r(-p)} ${u}A${r(m)} ${u} 0 0 1 ${r(-p)} ${-u}Z`), c.setAttribute("d", `M${r(h + m)} 0A${r(m)} ${u} 0 1 0 ${r(h - m)} 0A${r(m)} ${u} 0 1 0 ${r(h + m)} 0Z`)) : (s.setAttribute("d", `M${r(-p - m)} ${-u}H${r(p + m)}V${u}H${r(-p - m)}Z`), c.setAttribute("d", `M${r(h - m)} ${-u}H${r(h + m)}V${u}H${r(h - m)}Z`));
		},
		mark(e) {
			let [t, r] = i.point(n.p), [a, o] = i.here(n.e), s = n.shape === "ball" ? 0 : l;
			e.disc([t, r], 2.4), e.line([t - s * a, r + s * o], [t + s * a, r - s * o]);
		}
	};
}
var ke = 240, Ae = .04, je = 12, Me = 3;
function Ne(e, t, n) {
	let r = e[2 * t], i = e[2 * t + 1], a = e[2 * n] - r, o = e[2 * n + 1] - i, s = a * a + o * o;
	for (let c = t + 1; c < n; c++) {
		let t = e[2 * c] - r, n = e[2 * c + 1] - i, l = t * a + n * o;
		if ((t * o - n * a) ** 2 > Ae * Ae * s || l < 0 || l > s) return !1;
	}
	return !0;
}
function Pe(e, t) {
	e.getAttribute("d") !== t && e.setAttribute("d", t);
}
function Fe(e, t, n = !1) {
	let i = n && e.cyclic ? e.count : e.count - 1, a = e.count > ke, o = a && e.coarse ? Me : 1, s = Math.ceil(i / o), c = new Float64Array(2 * s + 2), l = "", u = -1, d = (e, t = "L") => {
		l += `${t}${r(c[2 * e])} ${r(c[2 * e + 1])}`, u = e;
	};
	for (let n = 0; n <= s; n++) {
		let r = Math.min(n * o, i) % e.count, s = !!e.good[r];
		s && c.set(t(r), 2 * n), s && u < 0 ? d(n, "M") : u >= 0 && u < n - 1 && !(s && a && n - u <= je && Ne(c, u, n)) && d(n - 1), s ? e.reverses(r) && (u < n && d(n), c.set(e.onceAfter(() => t(r)), 2 * n), d(n)) : u = -1;
	}
	return u >= 0 && u < s && d(s), l;
}
function Ie(e, t, n, r, a) {
	let { unit: o, size: s } = a.units[r] ?? {
		unit: "",
		size: 1
	};
	be(e, a.values ? `${t} = ${i(n / s)} ${o}`.trim() : t);
}
function Le(e, t, n, r, i, a = "force") {
	return t.t === "couple" ? He(e, t, n) : Be(e, t, n, r, i, a);
}
var Re = (e, t) => void (e.dataset.item = `${t.kind === "joint" ? "reaction" : t.kind}:${t.of}`), ze = 13;
function Be(e, t, n, r, i, a) {
	let o = new m(e, t.role, t.name), s = t.t === "force" ? null : new m(e, t.role), c = t.t === "force" ? t.f : t.m, l = ye(e, t.role, t.name, 3.4), u = [0, 0], d = [0, 0], f = [0, 0], p = !1;
	for (let e of [o, s]) e && Re(e.g, t);
	return {
		label: l,
		hide() {
			p = o.set([0, 0], [0, 0]), s?.set([0, 0], [0, 0]), l.el.setAttribute("visibility", "hidden");
		},
		update() {
			let e = n.point(t.p), [m, h] = n.here(c), g = s ? Math.hypot(...c.map((e) => n.kernel.here[e])) / ze || 1 : r(), _ = [m / g, -h / g], v = !1;
			if (i && i.length > 1 && !s) {
				let t = i.map((e) => n.point(e)), r = [0, 1].map((e) => t.reduce((t, n) => t + n[e], 0) / t.length);
				v = _[0] * (r[0] - e[0]) + _[1] * (r[1] - e[1]) > 1e-9;
			}
			[u, d] = v ? [[e[0] - _[0], e[1] - _[1]], e] : [e, [e[0] + _[0], e[1] + _[1]]], f = v ? u : d, p = o.set(u, d), s?.set(u, [u[0] + .78 * (d[0] - u[0]), u[1] + .78 * (d[1] - u[1])]), l.el.setAttribute("visibility", p ? "visible" : "hidden"), p && Ie(l, t.name, Math.hypot(...c.map((e) => n.kernel.here[e])), s ? "moment" : a, n);
		},
		mark: (e) => p && e.line(u, d),
		anchor() {
			if (!p) return null;
			let e = f === u ? d : u, t = [f[0] - e[0], f[1] - e[1]];
			return [
				f,
				[f[0] - .35 * t[0], f[1] - .35 * t[1]],
				t
			];
		}
	};
}
var Ve = 4.6;
function He(e, n, i) {
	let a = i.kernel.here, o = t("g", e), s = ye(e, n.role, n.name, 3.4);
	t("title", o).textContent = l(n.name), t("path", o, {
		class: `l-${n.role}`,
		style: "fill:none",
		d: "M4.17 1.94A4.6 4.6 0 1 0 -4.17 1.94"
	}), t("path", o, {
		class: `l-${n.role}-h`,
		d: "M-4.17 2.9L-5.6 -0.1L-3 0.3Z"
	});
	let c = !1;
	return Re(o, n), {
		label: s,
		hide() {
			c = !1, o.setAttribute("display", "none"), s.el.setAttribute("visibility", "hidden");
		},
		update() {
			let [e, t] = i.point(n.p), l = a[n.m[0]];
			c = Number.isFinite(l) && Math.abs(l) > 1e-9, o.setAttribute("display", c ? "inline" : "none"), s.el.setAttribute("visibility", c ? "visible" : "hidden"), o.setAttribute("transform", `translate(${r(e)} ${r(t)}) scale(${l < 0 ? -1 : 1} 1)`), c && Ie(s, n.name, Math.abs(l), "moment", i);
		},
		mark(e) {
			c && e.disc(i.point(n.p), Ve);
		},
		anchor() {
			let [e, t] = i.point(n.p);
			return c ? [
				[e, t - Ve],
				[e - Ve, t],
				[e + Ve, t],
				[e, t + Ve],
				[0, -1]
			] : null;
		}
	};
}
// src/view.ts
var Ue = [
	"loads",
	"reactions",
	"inertia",
	"velocities",
	"accelerations",
	"names",
	"traces",
	"values",
	"digits"
], We = [
	.1,
	.25,
	.5,
	1,
	2,
	4
], Ge = () => ({
	t: NaN,
	shown: {},
	window: null,
	camera: [-Math.PI / 3, .45],
	chosen: null,
	curve: "",
	body: "",
	tab: "",
	speed: 1,
	drag: "shape",
	tracers: []
});
function Ke(e) {
	let t = [], n = (e, n, r = "") => n !== r && t.push([`~${e}`, n]), r = (t) => Ue.filter((n) => e.shown[n] === t).join(" ");
	return n("show", r(!0)), n("hide", r(!1)), e.window && n("window", [e.window.perMm, ...e.window.middle].map((e) => +e.toPrecision(6)).join(" ")), n("tab", e.tab), n("speed", String(e.speed), "1"), n("drag", e.drag, "shape"), n("trace", e.tracers.map((e) => [e.link, ...e.u.map((e) => +e.toPrecision(6))].join(" ")).join("; ")), t;
}
function qe(e, t) {
	let n = (e) => t.get(`~${e}`) ?? "", r = (e) => e.split(" ").map(Number);
	for (let [t, r] of [["show", !0], ["hide", !1]]) for (let i of Ue) n(t).split(" ").includes(i) && (e.shown[i] = r);
	let [i, a, o] = r(n("window"));
	i > 0 && Number.isFinite(i + a + o) && (e.window = {
		perMm: i,
		middle: [a, o]
	}), e.tab = n("tab"), We.includes(+n("speed")) && (e.speed = +n("speed")), n("drag") === "turn" && (e.drag = "turn"), e.tracers = n("trace").split("; ").flatMap((e) => {
		let [t, ...n] = e.split(" "), r = n.map(Number);
		return r.length > 1 && r.every(Number.isFinite) ? [{
			link: t,
			u: r
		}] : [];
	});
}
function Je(e, t) {
	return {
		loads: !0,
		reactions: !0,
		inertia: !0,
		velocities: !1,
		accelerations: !1,
		names: !t,
		traces: !0,
		values: !1,
		digits: !1
	}[e];
}
// src/board.ts
var Ye = (e) => e.kind === "joint" || e.kind === "friction" ? "reactions" : e.kind === "inertia" ? "inertia" : "loads", Xe = [
	1,
	1.25,
	1.5,
	2,
	2.5,
	3,
	4,
	5,
	6,
	8,
	10
];
function Ze(e) {
	if (!(e > 0) || !Number.isFinite(e)) return 1;
	let t = 10 ** Math.floor(Math.log10(e) + 1e-12);
	return t * (Xe.find((n) => n * t >= e * (1 - 1e-12)) ?? 10);
}
function Qe(e) {
	let t = 10 ** Math.floor(Math.log10(e) + 1e-12);
	return t * ([5, 2].find((n) => n * t <= e * (1 + 1e-12)) ?? 1);
}
function $e(e) {
	let t = (e) => [Math.min(...e), Math.max(...e)], n = t(e.map((e) => e[0])), r = t(e.map((e) => e[1]));
	return Number.isFinite(n[0] + n[1] + r[0] + r[1]) ? {
		x: n,
		y: r
	} : null;
}
var et = (e) => e.t === "hull" || e.t === "path" ? e.p : e.t === "symbol" || e.t === "pair" ? [e.p] : [];
function tt(e) {
	return e.items.flatMap((e) => {
		if (e.t === "circle") return [{
			p: e.p,
			reach: (t) => Math.abs(t(e.r))
		}];
		let t = e.t === "symbol" && e.per_mm ? e.per_mm * Math.max(0, ...[...e.svg.matchAll(/ r="([\d.]+)"/g)].map((e) => +e[1])) : 0;
		return e.t === "symbol" && t ? [{
			p: e.p,
			reach: () => t
		}] : [];
	});
}
function nt(e, t, n) {
	let r = e.kernel, i = Math.max(1, Math.floor(r.count / 72)), a = [], o = t.items.flatMap(et);
	for (let t = 0; t < r.count; t += i) {
		if (!r.good[t]) continue;
		let i = (e) => r.value(e, t);
		for (let t of o) a.push(e.seen(t, i));
		a.push(...rt(e, n, i));
	}
	return $e(a);
}
var rt = (e, t, n) => t.flatMap(({ p: t, reach: r }) => [-1, 1].map((i) => e.seen(t, n).map((e) => e + i * r(n)))), it = (e) => e.items.some((e) => e.t === "pair"), at = class {
	arrow;
	line;
	text;
	constructor(e, n = !1) {
		this.arrow = n;
		let r = t("g", e, { class: "scale" });
		this.line = t("path", r, {
			class: "l-axis",
			style: "fill:none"
		}), this.text = t("text", r, {
			class: "l-note-t",
			"font-size": 2.8
		});
	}
	set([t, n], o, s) {
		let c = o / s.size, l = c > 0 && Number.isFinite(c);
		if (this.line.setAttribute("visibility", l ? "visible" : "hidden"), this.text.textContent = "", !l) return t;
		let u = Qe(26 * c), d = t + u / c, p = `${i(u)} ${s.unit}`, m = `M${r(t)} ${r(n - 1)}v2`, h = this.arrow ? `M${r(d - 2.4)} ${r(n - .8)}L${r(d)} ${r(n)}L${r(d - 2.4)} ${r(n + .8)}` : `M${r(d)} ${r(n - 1)}v2`;
		return this.line.setAttribute("d", m + a([[t, n], [d, n]]) + h), e(this.text, {
			x: r(d + 1.4),
			y: r(n + 1)
		}).textContent = p, d + 1.4 + f(p, 2.8);
	}
};
function ot(e, n, r, i) {
	return t("svg", e, {
		viewBox: `${-n / 2} ${-r / 2} ${n} ${r}`,
		role: "group",
		"aria-label": i
	});
}
var st = 8, ct = 20;
function lt(e, n, r, i, a, o, s, c, l, u = []) {
	let d = {
		length: s.length.size,
		force: s.force.size
	}, f = ot(e, a, o, c), p = new Te(n, r.per_mm, s, it(r) ? l.camera : null), m = [], h = [], g = r.labels.filter((e) => e.kind === "joint").length > st, _ = (e) => i && e !== "values" ? !0 : l.shown[e] ?? Je(e, g), v = r.force, y = {
		perMm: r.per_mm,
		middle: r.middle ?? [0, 0]
	};
	r.middle && (p.middle = r.middle);
	let b = t("g", f), x = t("g", f), S = t("g", f), C = t("g", f);
	for (let e of r.items) (e.t === "trace" ? m : h).push(Ee(e.t === "trace" ? b : x, e, p));
	let w = r.arrows.map((e) => ({
		a: Le(S, e, p, () => v, i ?? void 0),
		layer: Ye(e)
	})), T = new at(C), E = new at(C, !0), D = r.arrows.filter((e) => e.t === "force"), O = (u.length ? ["velocities", "accelerations"] : []).map((e) => {
		let t = e === "velocities" ? "speed" : "acceleration", n = e === "velocities" ? "velocity" : "acceleration", r = n[0], i = {
			layer: e,
			unit: s[t],
			rows: u.map((e) => r === "v" ? e.v : e.a),
			perMm: NaN,
			bar: new at(C, !0)
		};
		return u.forEach((a, o) => {
			let s = {
				t: "force",
				role: n,
				of: a.of[1],
				kind: n,
				link: "",
				name: `${r}_{${a.of[0] === "center" ? `G ${a.of[1]}` : a.of[1]}}`,
				p: a.p,
				f: i.rows[o]
			};
			w.push({
				a: Le(S, s, p, () => i.perMm, void 0, t),
				layer: e
			});
		}), i;
	}), k = r.labels.map((e) => ({
		l: ye(C, e.role, e.text, e.kind === "joint" ? 3.8 : 3.3),
		p: e.p,
		q: e.q
	})), A = tt(r), j = Math.max(1, Math.floor(n.count / 72)), M = (e) => [(e.x[0] + e.x[1]) / 2, (e.y[0] + e.y[1]) / 2], N = i ? [
		...i,
		...r.arrows.map((e) => e.p),
		...r.items.flatMap((e) => e.t === "symbol" ? [e.p] : [])
	] : [];
	function P(e) {
		return $e([...N.map((t) => p.seen(t, e)), ...rt(p, A, e)]);
	}
	function F() {
		return Array.from({ length: Math.ceil(n.count / j) }, (e, t) => t * j).flatMap((e) => {
			let t = n.good[e] ? P((t) => n.value(t, e)) : null;
			return t ? [{
				k: e,
				b: t
			}] : [];
		});
	}
	function I() {
		let e = n.largest((e) => Math.max(0, ...D.map((t) => Math.hypot(...t.f.map((t) => n.value(t, e)))))) / (i ? 26 : Math.min(Math.max(.18 * Math.min(a, 1.3 * o), 16), 40));
		for (let { k: t, b: r } of i ? F() : []) for (let i of D) {
			let s = (e) => n.value(e, t), c = p.seen(i.p, s), l = p.seen(i.f, s);
			[a / 2 - 9, o / 2 - 12].forEach((t, n) => {
				let i = n ? (r.y[0] + r.y[1]) / 2 : (r.x[0] + r.x[1]) / 2, a = t - Math.abs(c[n] - i) / p.perMm;
				e = Math.max(e, Math.abs(l[n]) / Math.max(a, 4));
			});
		}
		return e > 0 ? Ze(e / d.force) * d.force : v;
	}
	function L(e, t = !1) {
		let s = i ? F().map(({ b: e }) => e) : [nt(p, r, A)].filter((e) => e !== null), c = i ? [46, 40] : [a - Math.max(.22 * a, 34), o - Math.max(.22 * o, 30)], l = Math.max(0, ...s.flatMap((e) => [(e.x[1] - e.x[0]) / c[0], (e.y[1] - e.y[0]) / c[1]]));
		t && s.length && R(s[0], l) || (!i && s.length && (y.middle = M(s[0])), l > 0 && (y.perMm = Ze(l / d.length) * d.length)), v = e ?? I();
		for (let e of O) {
			let t = n.largest((t) => Math.max(0, ...e.rows.map((e) => Math.hypot(...e.map((e) => n.value(e, t))))));
			e.perMm = t > 0 ? Ze(t / ct / e.unit.size) * e.unit.size : NaN;
		}
		z();
	}
	function R(e, t) {
		let n = (e, t, n) => Math.max(...e.map((e) => Math.abs(e - t))) < y.perMm * n;
		return t > .5 * y.perMm && n(e.x, y.middle[0], a / 2 - 8) && n(e.y, y.middle[1], o / 2 - 10);
	}
	function z() {
		let e = i ? y : l.window ?? y;
		p.perMm = e.perMm, i || (p.middle = [...e.middle]);
	}
	function B() {
		let e = [
			[
				T,
				p.perMm,
				s.length
			],
			[
				E,
				D.length ? v : NaN,
				s.force
			],
			...O.map((e) => [
				e.bar,
				_(e.layer) && !i ? e.perMm : NaN,
				e.unit
			])
		], [t, n] = [-a / 2 + 2, o / 2 - 2.6];
		for (let [r, i, o] of e) {
			t > -a / 2 + 2 && t + 46 > a / 2 && ([t, n] = [-a / 2 + 2, n - 5]);
			let e = r.set([t, n], i, o);
			e > t && (t = e + 5);
		}
	}
	function V() {
		let e = new xe([
			-a / 2,
			-o / 2,
			a / 2,
			o / 2 - 6
		]), t = ([e, t]) => Math.abs(e) < a / 2 && Math.abs(t) < o / 2;
		for (let t of [...h, ...w.map((e) => e.a)]) t.mark?.(e);
		for (let { l: n, p: r, q: i } of k) {
			let a = p.point(r), o = i ? p.point(i) : a, s = (_("names") || !!i && l.shown.names === void 0) && t([(a[0] + o[0]) / 2, (a[1] + o[1]) / 2]);
			if (n.el.setAttribute("visibility", s ? "visible" : "hidden"), !s) continue;
			let c = (i ? [
				.5,
				.35,
				.65
			] : [0]).map((e) => [a[0] + e * (o[0] - a[0]), a[1] + e * (o[1] - a[1])]);
			e.put({
				label: n,
				anchors: c,
				away: i ? void 0 : a,
				leave: i ? .8 : 1.3
			});
		}
		for (let { a: r } of w) {
			let i = n.solved ? r.anchor() : null;
			!i || !t(i[0]) ? r.label.el.setAttribute("visibility", "hidden") : e.put({
				label: r.label,
				anchors: i.slice(0, -1),
				away: i[i.length - 1],
				leave: .9
			});
		}
	}
	return {
		svg: f,
		paper: p,
		fit: L,
		need: I,
		look: z,
		on: _,
		force: () => v,
		fitted: () => y.perMm,
		resize(e, t) {
			[a, o] = [e, t], f.setAttribute("viewBox", `${-a / 2} ${-o / 2} ${a} ${o}`);
		},
		update(e) {
			if (p.values = _("values"), b.setAttribute("display", _("traces") ? "inline" : "none"), e && m.forEach((e) => e.update()), S.setAttribute("visibility", n.solved ? "visible" : "hidden"), B(), n.finite) {
				i && (p.middle = M(P((e) => n.here[e]) ?? {
					x: [0, 0],
					y: [0, 0]
				}));
				for (let e of h) e.update();
				for (let { a: e, layer: t } of w) _(t) ? e.update() : e.hide();
				V();
			}
		}
	};
}
// src/menu.ts
function ut(e, [t, r], i) {
	if (e.querySelector(".menu")?.remove(), !i.length) return;
	let a = document.activeElement, o = n("div", e, {
		class: "menu",
		role: "menu",
		"aria-label": "of this place"
	}), s = () => {
		o.isConnected && (o.remove(), document.removeEventListener("pointerdown", c, !0), a?.focus?.());
	}, c = (e) => {
		e.composedPath().includes(o) || s();
	}, l = i.map(({ said: e, act: t }) => {
		let r = n("button", o, {
			type: "button",
			role: "menuitem"
		}, e);
		return r.addEventListener("click", () => (s(), t())), r;
	});
	o.addEventListener("keydown", (e) => {
		let t = l.indexOf(document.activeElement), n = l.length, r = {
			ArrowDown: (t + 1) % n,
			ArrowUp: (t + n - 1) % n,
			Home: 0,
			End: n - 1
		}[e.key];
		if (r !== void 0) l[r].focus();
		else if (e.key === "Escape" || e.key === "Tab") s();
		else return;
		e.preventDefault(), e.stopPropagation();
	});
	let { width: u, height: d } = o.getBoundingClientRect();
	o.style.left = `${Math.max(4, Math.min(t, window.innerWidth - u - 4))}px`, o.style.top = `${Math.max(4, Math.min(r, window.innerHeight - d - 4))}px`, document.addEventListener("pointerdown", c, !0), l[0].focus({ preventScroll: !0 });
}
// src/viewport.ts
var dt = 1e4, ft = 12, pt = 1.25;
function mt(e, t, n, r, i, a) {
	let { svg: o, paper: c } = e, l = /* @__PURE__ */ new Map(), u = !1, d = (n, r) => {
		let i = e.fitted();
		n > i / dt && n < i * dt && r.every(Number.isFinite) && (t.window = {
			perMm: n,
			middle: r
		}, e.look(), a());
	}, f = ([e, t]) => d(c.perMm, [c.middle[0] - e * c.perMm, c.middle[1] + t * c.perMm]), p = (e, t = [0, 0]) => {
		let [n, r] = c.metres(t), i = c.perMm / e;
		d(i, [n - t[0] * i, r + t[1] * i]);
	}, m = () => {
		t.window = null, e.look(), a();
	};
	o.addEventListener("wheel", (e) => {
		if (!n && !e.ctrlKey && !e.metaKey) return;
		e.preventDefault();
		let t = e.deltaMode === 1 ? 16 : 1;
		p(Math.exp(-e.deltaY * t * (e.ctrlKey ? .01 : .0015)), s(o, e));
	}, { passive: !1 }), o.addEventListener("pointerdown", (e) => {
		e.pointerType === "mouse" && e.button > 1 || (l.size || e.button === 1 || r(e)) && (e.button === 1 && e.preventDefault(), o.setPointerCapture(e.pointerId), l.set(e.pointerId, s(o, e)), u = !1);
	}), o.addEventListener("pointermove", (e) => {
		let t = l.get(e.pointerId);
		if (!t) return;
		let n = s(o, e), r = [n[0] - t[0], n[1] - t[1]];
		u = !0;
		let a = [...l].find(([t]) => t !== e.pointerId)?.[1];
		if (l.set(e.pointerId, n), a) {
			let e = (e) => Math.hypot(e[0] - a[0], e[1] - a[1]) || 1;
			p(e(n) / e(t), a);
		} else i && !e.shiftKey && e.buttons !== 4 ? i(r) : f(r);
	});
	let h = (e) => void l.delete(e.pointerId);
	return o.addEventListener("pointerup", h), o.addEventListener("pointercancel", h), o.addEventListener("lostpointercapture", h), o.addEventListener("dblclick", (e) => {
		r(e) && m();
	}), o.addEventListener("click", (e) => u && e.stopImmediatePropagation(), { capture: !0 }), o.tabIndex = 0, o.addEventListener("keydown", (e) => {
		if (e.target !== o || e.ctrlKey || e.metaKey || e.altKey) return;
		let t = {
			ArrowLeft: [ft, 0],
			ArrowRight: [-12, 0],
			ArrowUp: [0, ft],
			ArrowDown: [0, -12]
		};
		if (t[e.key]) f(t[e.key]);
		else if (e.key === "+" || e.key === "=") p(pt);
		else if (e.key === "-") p(1 / pt);
		else if (e.key === "0") m();
		else return;
		e.preventDefault(), e.stopPropagation();
	}), {
		zoom: p,
		fit: m,
		pan: f
	};
}
// src/stage.ts
var ht = 3.6, gt = 5.2, _t = 550, vt = 8;
function yt(e, r, i, a, o, c) {
	let l = n("div", e, { class: "paper" }), u = lt(l, r, i, null, 170, 119, a, "the mechanism", o, c.rates ?? []), { svg: d } = u, f = t("g", d, { class: "overlay" }), p = u.paper.axes.length > 2, m = (e) => {
		let t = e.target.closest("[data-item]")?.dataset.item;
		return t ? G(t) : null;
	}, h = (e) => !v(e.clientX, e.clientY, e.pointerType === "touch" ? 14 : 6).some(c.held), g = () => {
		c.on?.({
			type: "view",
			view: o
		}), c.again(!0);
	}, _ = p ? (e) => (u.paper.turn(-.045 * e[0], .045 * e[1]), g()) : null, v = (e, t, n = 6) => K(d, e, t, n), y = mt(u, o, !!c.full, h, _, g);
	p && (d.style.cursor = "move");
	let b = (e, t) => u.paper.metres(s(d, {
		clientX: e,
		clientY: t
	})), x = (e) => {
		o.chosen = e, ae(d, e), c.chosen(e);
	}, S = (e) => [e.clientX, e.clientY];
	d.addEventListener("click", (e) => {
		let t = v(e.clientX, e.clientY, e.pointerType === "touch" ? 14 : 6), n = t.length ? t : m(e) ? [m(e)] : [];
		c.on?.({
			type: "select",
			items: n,
			at: S(e),
			point: b(e.clientX, e.clientY)
		}) || x(n[0] && !ie(n[0], o.chosen) ? n[0] : null);
	});
	let C = (t, n) => {
		let r = b(...n);
		t[0] && x(t[0]), c.on?.({
			type: "menu",
			items: t,
			at: n,
			point: r
		}) || ut(e.closest(".dalembert") ?? document.body, n, c.entries(t, r));
	};
	d.addEventListener("contextmenu", (e) => {
		e.preventDefault();
		let t = e.button < 0 || e.clientX === 0 && e.clientY === 0 ? m(e) : null;
		if (!t) return C(v(e.clientX, e.clientY), S(e));
		let n = e.target.getBoundingClientRect();
		C([t], [n.left + n.width / 2, n.top + n.height / 2]);
	}), d.addEventListener("keydown", (e) => {
		if (e.key !== "ContextMenu" && !(e.key === "F10" && e.shiftKey)) return;
		e.preventDefault();
		let t = e.target.getBoundingClientRect(), n = m(e);
		C(n ? [n] : [], [t.left + t.width / 2, t.top + t.height / 2]);
	});
	let w = 0, T = [0, 0];
	d.addEventListener("pointerdown", (e) => {
		clearTimeout(w), e.pointerType === "touch" && e.isPrimary && (T = S(e), w = window.setTimeout(() => C(v(e.clientX, e.clientY, 14), T), _t));
	}, { capture: !0 });
	let E = () => clearTimeout(w);
	d.addEventListener("pointermove", (e) => Math.hypot(e.clientX - T[0], e.clientY - T[1]) > vt && E(), { capture: !0 });
	for (let e of ["pointerup", "pointercancel"]) d.addEventListener(e, E, { capture: !0 });
	return {
		m: u,
		paper: l,
		view: y,
		overlay: f,
		hit: v,
		metres: b,
		choose: x,
		resize() {
			let { width: e, height: t } = l.getBoundingClientRect();
			if (!(e > 0 && t > 0)) return;
			let n = Math.min(Math.max(Math.min(e / 170, t / 105), ht), gt);
			u.resize(e / n, t / n);
		}
	};
}
// src/switches.ts
var bt = {
	loads: ["loads", "loads, efforts of drives, weights, springs"],
	reactions: ["reactions", "forces in the joints"],
	inertia: ["inertia", "D'Alembert's inertia forces and couples"],
	velocities: ["velocities", "velocities of joints and mass centres"],
	accelerations: ["accelerations", "accelerations of joints and mass centres"],
	names: ["names", "names of joints and links"],
	traces: ["paths", "paths of the joints"],
	values: ["values", "the value beside each arrow"],
	digits: ["large digits", "the chosen curve's value, to be read from the last row"]
};
function xt(e, t) {
	let r = n("label", e, { title: t.title }), i = n("input", r, { type: "checkbox" });
	i.checked = t.on, r.append(t.said), i.addEventListener("change", () => t.act(i.checked));
}
function St(e, t, n, r, i) {
	for (let a of n) {
		let [n, o] = bt[a];
		xt(e, {
			said: n,
			title: o,
			on: t.shown[a] ?? Je(a, r),
			act: (e) => (t.shown[a] = e, i())
		});
	}
}
function Ct(e, t, r, i, a) {
	let o = n("span", e, {
		class: "group",
		role: "group",
		"aria-label": "view"
	}), s = (e, t, r) => {
		let i = n("button", o, {
			type: "button",
			title: t,
			.../^\w/.test(e) ? {} : { "aria-label": t }
		}, e);
		return i.addEventListener("click", r), i;
	};
	if (s("−", "zoom out (-)", () => t.zoom(.8)), s("+", "zoom in (+)", () => t.zoom(1.25)), s("fit", "the whole mechanism (0)", () => t.fit()), !i) return;
	let c = n("span", e, {
		class: "group",
		role: "group",
		"aria-label": "dragging"
	}), l = ["shape", "turn"].map((e) => {
		let t = n("button", c, {
			type: "button",
			title: e === "shape" ? "dragging a joint changes the mechanism" : "dragging a joint or a link turns the mechanism"
		}, e === "shape" ? "reshape" : "turn");
		return t.addEventListener("click", () => {
			r.drag = e, u(), a();
		}), {
			way: e,
			b: t
		};
	}), u = () => l.forEach(({ way: e, b: t }) => t.setAttribute("aria-pressed", String(r.drag === e)));
	u();
}
// src/tools.ts
var wt = class {
	b;
	data;
	kernel;
	on = !1;
	arrows;
	constructor(e, n, r) {
		this.b = e, this.data = n, this.kernel = r;
		let i = t("g", e.svg, { class: "gradient" }), a = n.gradient ? n.handles.flatMap((e) => "ends" in e && e.ends.length ? [e] : []) : [];
		this.arrows = a.map((e) => ({
			p: e.p,
			ends: e.ends,
			arrow: new m(i, "acceleration", `lower the peak by ${e.name}`)
		}));
	}
	peak(e) {
		let t = this.kernel, n = (n) => Math.abs(t.value(e.row, n)), r = t.largest(n), i = Math.max(0, t.good.findIndex((e, t) => e > 0 && n(t) === r));
		return {
			k: i,
			size: r,
			where: t.count > 1 ? ` at ${Tt(this.data, t, i)}` : ""
		};
	}
	update(e) {
		let t = this.data.gradient, n = this.kernel, r = e && t ? t.curves.indexOf(e.row) : -1;
		if (!this.on || r < 0 || !t || !e || !n.solved) return this.arrows.forEach((e) => e.arrow.set([0, 0], [0, 0]));
		let i = this.peak(e).k, a = n.gradient(r, i), o = -Math.sign(n.value(e.row, i)) || 1, s = new Map(t.numbers.map((e, t) => [e, a[t]])), c = this.arrows.map(({ ends: e }) => {
			let t = this.b.paper.axes[0].map(() => 0);
			for (let r of e) r.axes.forEach((e, i) => e.forEach((e, a) => t[a] += o * n.here[e] * (s.get(r.n[i]) ?? 0)));
			return this.b.paper.project(t);
		}), l = Math.max(...c.map((e) => Math.hypot(...e)), 1e-300);
		this.arrows.forEach(({ p: e, arrow: t }, n) => {
			let [r, i] = this.b.paper.point(e), [a, o] = c[n];
			t.set([r, i], [r + 14 * a / l, i - 14 * o / l], .5);
		});
	}
}, Tt = (e, t, n) => e.drives.map((e) => `${e.name} = ${i(t.position(e.name, n) / e.size, 5)}${e.unit === "°" ? "" : " "}${e.unit}`).join(", "), Et = class {
	b;
	kernel;
	places;
	on = !1;
	part = .005;
	draws;
	out;
	numbers;
	canvas;
	constructor(e, t, n, r, i) {
		this.b = t, this.kernel = r, this.places = i, this.numbers = n.numbers.flatMap((e, t) => /\.points\./.test(e.path) || e.path.endsWith(".center.0") || e.path.endsWith(".center.1") ? [t] : []), this.canvas = document.createElement("canvas"), this.canvas.className = "cloud", this.canvas.setAttribute("aria-hidden", "true"), e.append(this.canvas), this.out = new Float64Array(r.here.length);
		let a = 12345, o = () => ((a = Math.imul(a, 1664525) + 1013904223 >>> 0) + .5) / 4294967296, s = () => Math.sqrt(-2 * Math.log(o())) * Math.cos(2 * Math.PI * o());
		this.draws = Array.from({ length: 1e3 }, () => Float64Array.from({ length: this.numbers.length }, s));
	}
	update(e) {
		let t = this.canvas;
		if (t.hidden = !this.on, !this.on) return null;
		let n = this.b.svg.getBoundingClientRect(), r = window.devicePixelRatio || 1, [i, a] = [Math.round(n.width * r), Math.round(n.height * r)];
		(t.width !== i || t.height !== a) && (t.width = i, t.height = a);
		let o = t.getContext("2d"), s = this.b.svg.viewBox.baseVal, c = Math.min(i / s.width, a / s.height);
		o.clearRect(0, 0, i, a), o.fillStyle = "rgba(122,47,160,.25)";
		let l = this.kernel, u = l.values.slice(), d = this.part * this.reach() / 3, f = u.slice(), p = 0, m = 0, h = 0;
		for (let t of this.draws) if (this.numbers.forEach((e, n) => f[e] = u[e] + d * t[n]), l.other(f, this.out), l.numbered(this.out[this.out.length - 1])) {
			for (let e of this.places) {
				let [t, n] = this.b.paper.of(...this.b.paper.seen(e, (e) => this.out[e]));
				o.fillRect((t - s.x) * c + (i - s.width * c) / 2, (n - s.y) * c + (a - s.height * c) / 2, r, r);
			}
			e !== void 0 && (p += this.out[e], m += this.out[e] ** 2, h++);
		}
		l.other(u, this.out);
		let g = p / (h || 1);
		return h ? {
			mean: g,
			sigma: Math.sqrt(Math.max(m / h - g * g, 0))
		} : null;
	}
	reach() {
		return this.b.svg.viewBox.baseVal.width * .5 * this.b.paper.perMm;
	}
}, Dt = class {
	kernel;
	gate;
	past = [];
	future = [];
	now;
	constructor(e, t) {
		this.kernel = e, this.gate = t, this.now = e.state();
	}
	note() {
		this.kernel.values.every((e, t) => e === this.now[t]) || (this.past.push(this.now), this.past.length > 500 && this.past.shift(), this.future = [], this.now = this.kernel.state());
	}
	go(e) {
		let t = e ? this.past : this.future, n = e ? this.future : this.past, r = t.pop();
		return r ? (n.push(this.now), this.now = r, this.kernel.restore(r), this.gate.accept(this.kernel.values), !0) : !1;
	}
	get can() {
		return [this.past.length > 0, this.future.length > 0];
	}
};
function Ot(e, t) {
	let n = e.numbers.flatMap((e, n) => t.values[n] === e.value ? [] : [[e.path, t.values[n]]]), r = n.length ? t.motion.assembly() : [];
	return Object.fromEntries([...n, ...r.map((t, n) => [e.sketch.assembly[n], t])]);
}
function kt(e, t, n) {
	let r = new URLSearchParams({ t: String(+n.t.toFixed(4)) });
	for (let [e, t] of Ke(n)) r.set(e, t);
	for (let [n, i] of Object.entries(Ot(e, t))) r.set(n, String(i));
	return r.toString();
}
function At(e, t, n, r) {
	let i = new Map(new URLSearchParams(r.replace(/^#/, ""))), a = {};
	qe(n, i);
	for (let [e, t] of i) e !== "t" && !e.startsWith("~") && (a[e] = t.trim() ? Number(t) : NaN);
	t.change(a);
	let o = Number(i.get("t") ?? NaN);
	Number.isFinite(o) && (n.t = Math.min(Math.max(o, 0), e.end));
}
function jt(e, t) {
	let n = [...t.values, ...t.motion.assembly()], r = e.numbers.map((e, n) => e.value !== t.values[n]), i = r.includes(!0);
	return e.template.map((e) => typeof e == "string" ? e : e.was !== void 0 && !e.of?.some((e) => r[e] ?? i) ? e.was : e.now.map((e) => typeof e == "string" ? e : String(n[e[0]] / e[1])).join("")).join("");
}
function Mt(e, t) {
	let n = (e) => /[",\n]/.test(e) || /^[=+\-@]/.test(e) ? `"${e.replace(/^([=+\-@])/, "'$1").replace(/"/g, "\"\"")}"` : e, r = e.views.charts.flatMap((t) => t.curves.map((n) => ({
		x: n,
		unit: e.units[t.kind]
	}))), i = [[
		...e.drives.map((e) => `${e.name} [${e.unit}]`),
		"status",
		...r.map(({ x: e, unit: t }) => `${e.of} [${t.unit}]`)
	].map(n).join(",")];
	for (let n = 0; n < t.count; n++) {
		let a = e.drives.map((e) => t.positions.get(e.name)[n] / e.size);
		i.push([
			...a,
			e.statuses[t.markAt(n)].status,
			...r.map(({ x: e, unit: r }) => t.good[n] ? t.value(e.row, n) / r.size : "")
		].join(","));
	}
	return i.join("\n") + "\n";
}
function Nt(n, r) {
	let i = n.cloneNode(!0), { width: a, height: o } = n.viewBox.baseVal;
	i.querySelectorAll(".handles, .overlay").forEach((e) => e.remove()), e(i, {
		xmlns: "http://www.w3.org/2000/svg",
		width: `${a}mm`,
		height: `${o}mm`,
		"font-family": "'DejaVu Sans', Arial, sans-serif"
	});
	let s = t("style", null);
	return s.textContent = r, i.prepend(s), new XMLSerializer().serializeToString(i);
}
var Pt = 300 / 25.4;
async function Ft(e, t) {
	let { width: n, height: r } = e.viewBox.baseVal, i = new Image(), a = URL.createObjectURL(new Blob([Nt(e, t)], { type: "image/svg+xml" }));
	try {
		i.src = a, await i.decode();
		let e = document.createElement("canvas"), t = e.getContext("2d");
		return [e.width, e.height] = [Math.round(n * Pt), Math.round(r * Pt)], t.fillStyle = "#fff", t.fillRect(0, 0, e.width, e.height), t.drawImage(i, 0, 0, e.width, e.height), await new Promise((t, n) => e.toBlob((e) => e ? t(e) : n(/* @__PURE__ */ Error("the picture is too large")), "image/png"));
	} finally {
		URL.revokeObjectURL(a);
	}
}
function X(e, t, n) {
	let r = document.createElement("a");
	r.href = URL.createObjectURL(new Blob([t], { type: n })), r.download = e, r.click(), setTimeout(() => URL.revokeObjectURL(r.href), 1e3);
}
var It = (e) => l(e).toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "").slice(0, 60) || "mechanism", Lt = class {
	data;
	program;
	here;
	count = 1;
	good = new Uint8Array([1]);
	cyclic = !1;
	finite = !0;
	open = [];
	inputs;
	constructor(e, t) {
		this.data = e, this.program = t, this.here = new Float64Array(e.shown.outputs), this.inputs = t.module.channels.map((e) => {
			let [, t, n] = e.split(" ");
			return [t, +n];
		});
	}
	get solved() {
		return this.finite;
	}
	show(e) {
		this.inputs.forEach(([t, n], r) => this.program.put(r, e[t][n])), this.program.call(1);
		for (let e = 0; e < this.here.length; e++) this.here[e] = this.program.at(e);
		this.finite = this.here.every(Number.isFinite);
		let t = (e) => e.map((e) => this.here[e]), n = this.data.gaps.map((e) => ({
			joint: e.joint,
			p: t(e.p),
			q: t(e.q)
		}));
		this.open = n.filter((e) => Math.hypot(...e.p.map((t, n) => t - e.q[n])) > 1e-6 * this.data.sketch.length);
	}
	value(e) {
		return this.here[e];
	}
	reverses() {
		return !1;
	}
	onceAfter(e) {
		return e();
	}
	largest(e) {
		return e(0);
	}
}, Rt = .02, zt = 2, Bt = 500;
async function Vt(o, c, l, u) {
	let [d, f] = await Promise.all([W.create(c.sketch.closure, 1), W.create(c.shown, 1)]), m = c.sketch, h = {
		point: Float64Array.from(m.pose.point),
		rotation: Float64Array.from(m.pose.rotation),
		turn: Float64Array.from(m.pose.turn)
	}, v = new Lt(c, f), y = new ge(m, d, V(m, h, u.pose ?? {})), b = [], x = new _(m.links, c.poses, v), S = [], C = [], w = null, T = [], E = "there", O = 0, k = y.pose;
	v.show(y.pose);
	let A = n("header", o);
	n("h1", A, {}, c.title);
	let j = n("div", A, {
		class: "bar",
		role: "toolbar",
		"aria-label": "sketch"
	}), M = (e, t, r, i) => {
		let a = n("button", e, {
			type: "button",
			title: r,
			.../^\w/.test(t) ? {} : { "aria-label": r }
		}, t);
		return a.addEventListener("click", i), a;
	};
	n("output", j, { class: "readout" }, "Sketch: drag the links.").style.flex = "1", u.back && M(j, "Back", "undo the last addition", u.back);
	let N = M(j, "↶", "undo (Ctrl+Z)", () => J(S, C)), P = M(j, "↷", "redo (Ctrl+Y)", () => J(C, S));
	M(j, "Reset", "as in the file", () => le(() => y.placed(D(h))));
	let F = n("section", n("main", o, { class: "one" }), {
		class: "stage",
		"aria-label": "sketch"
	}), I = yt(F, v, c.views.mechanism, c.units, l, {
		full: u.full,
		on: u.on,
		entries: ie,
		chosen: () => Y(),
		again: () => Y(),
		held: (e) => U(`${e.kind}:${e.name}`) >= 0
	}), { m: L, paper: R } = I, z = g(L, c, v), B = t("g", L.svg, { class: "handles" }), ee = t("g", L.svg, {
		class: "gaps",
		"pointer-events": "none"
	}), te = re().map(({ link: e, point: n, p: r }) => {
		let i = t("circle", B, {
			class: "handle joint",
			r: 2.2,
			tabindex: 0,
			role: "slider",
			"aria-label": `pull ${n} of ${e}`,
			"aria-valuetext": `${n} of ${e}`,
			"aria-valuenow": 0,
			"data-item": `point:${e}.${n}`
		});
		return t("title", i).textContent = `drag ${n} of ${e}`, i.addEventListener("keydown", (t) => {
			let n = {
				ArrowLeft: [-1, 0],
				ArrowRight: [1, 0],
				ArrowUp: [0, -1],
				ArrowDown: [0, 1]
			}[t.key];
			if (!n) return;
			t.preventDefault(), t.stopPropagation();
			let i = zt * (t.shiftKey ? 5 : 1), a = L.paper.point(r);
			le(() => {
				let t = {
					link: m.links.indexOf(e),
					u: x.local(L.paper, m.links.indexOf(e), a)
				};
				y.frame(t, L.paper.metres([a[0] + i * n[0], a[1] + i * n[1]]), ce());
			});
		}), {
			knob: i,
			p: r
		};
	}), H = n("div", null, {
		class: "missing",
		role: "status"
	});
	R.before(H), n("p", H, {}, c.missing.sentence[0].toUpperCase() + c.missing.sentence.slice(1) + ".");
	for (let e of c.missing.offers) M(H, `+ ${e.said}`, e.page ? e.said : "add it and save the model file", () => void K(e));
	G();
	function U(e) {
		return e.startsWith("point:") ? m.links.indexOf(e.slice(6, e.lastIndexOf("."))) : oe(c, e);
	}
	function re() {
		let e = /* @__PURE__ */ new Set();
		return c.points.filter(({ p: t }) => {
			let n = t.map((e) => v.here[e].toFixed(9)).join();
			return !e.has(n) && e.add(n);
		});
	}
	function G() {
		let e = n("div", F, { class: "switches" }), t = It(c.title);
		Ct(e, I.view, l, !1, () => Y()), St(e, l, c.views.mechanism.arrows.length ? ["names", "loads"] : ["names"], !1, () => Y());
		let r = n("span", e, {
			class: "group",
			role: "group",
			"aria-label": "save"
		});
		M(r, "Model file", "the file with the pose that is drawn", () => X(`${t}.yaml`, ae(), "text/yaml")), M(r, "SVG", "the drawing", () => X(`${t}.svg`, Nt(L.svg, c.style.light), "image/svg+xml")), M(r, "PNG", "the drawing", () => void Ft(L.svg, c.style.light).then((e) => X(`${t}.png`, e, "image/png")));
	}
	function ie(e) {
		return e.flatMap(({ kind: e, name: t }) => m.rows.flatMap((n, r) => e === "joint" && n.joint === t && n.kind === "freedom" ? [{
			said: `${y.locked(r) ? "Release" : "Lock"} the ${n.angular ? "turn" : "slide"} of ${t}`,
			act: () => y.lock(r, !y.locked(r))
		}] : []));
	}
	async function K(e) {
		if (!u.on?.({
			type: "offer",
			offer: e
		})) {
			if (!e.page) return X(`${It(c.title)}.yaml`, e.text, "text/yaml");
			await u.taken(JSON.parse(new TextDecoder().decode(await ne(e.page))), q());
		}
	}
	function ae() {
		let e = m.links.flatMap((e, t) => [
			y.pose.point[2 * t],
			y.pose.point[2 * t + 1],
			y.pose.turn[t]
		]);
		return c.text.replace(/@@(\d+)@@/g, (t, n) => String(e[+n]));
	}
	function q() {
		return Object.fromEntries(m.links.map((e, t) => [e, [
			y.pose.point[2 * t],
			y.pose.point[2 * t + 1],
			y.pose.turn[t]
		]]));
	}
	let ce = () => Rt * L.paper.perMm / m.length;
	function le(e) {
		k = y.pose, e(), ue();
	}
	function ue() {
		k !== y.pose && (S.push(k), S.length > Bt && S.shift(), C.length = 0), u.on?.({
			type: "pose",
			pose: q(),
			closed: y.closed
		}), Y();
	}
	function J(e, t) {
		let n = e.pop();
		n && (t.push(y.pose), y.placed(n), Y());
	}
	L.svg.addEventListener("pointerdown", (e) => {
		let t = e.button === 0 ? se(L.svg, e, U) : -1;
		if (t < 0) return;
		L.svg.setPointerCapture(e.pointerId);
		let n = s(L.svg, e);
		[w, T, k] = [
			{
				link: t,
				u: x.local(L.paper, t, n)
			},
			L.paper.metres(n),
			y.pose
		];
	}), L.svg.addEventListener("pointermove", (e) => {
		w && L.svg.hasPointerCapture(e.pointerId) && (T = L.paper.metres(s(L.svg, e)), E = "on the way", Y());
	});
	let de = () => {
		w && (w = null, E = "there", ue());
	};
	L.svg.addEventListener("pointerup", de), L.svg.addEventListener("pointercancel", de);
	function Y() {
		O ||= requestAnimationFrame(() => {
			O = 0;
			let e = performance.now();
			fe(), b.push(performance.now() - e), b.length > 2e3 && b.shift();
		});
	}
	function fe() {
		if (w || !y.closed) {
			let e = y.pose;
			E !== "on the way" && y.closed || (E = y.frame(w, T, ce())), (E === "on the way" || E === "apart" && e !== y.pose) && Y();
		}
		v.show(y.pose), L.update(!0);
		for (let { knob: t, p: n } of te) {
			let [i, a] = L.paper.point(n);
			e(t, {
				cx: r(i),
				cy: r(a)
			});
		}
		z(), pe(), [N.disabled, P.disabled] = [!S.length, !C.length];
	}
	function pe() {
		if (ee.replaceChildren(), !w || E !== "nearest" || y.away < 3 * ce()) return;
		let [n, o] = [y.at(w), T].map((e) => L.paper.of(...L.paper.project(e))), { unit: s, size: l } = c.units.length;
		t("path", ee, {
			class: "l-gap",
			d: a([n, o]),
			style: "fill:none"
		}), e(p(ee, "gap", `${i(y.away * m.length / l, 3)} ${s} too far`, 3.3, o[0] < n[0] == o[1] < n[1] ? "start" : "end"), {
			x: r((n[0] + o[0]) / 2 + (o[0] < n[0] == o[1] < n[1] ? 2.5 : -2.5)),
			y: r((n[1] + o[1]) / 2 - 1.5)
		});
	}
	let me = u.full ? document : o, he = (e) => {
		let t = e;
		(t.ctrlKey || t.metaKey) && !t.altKey && /^[zy]$/i.test(t.key) && (t.preventDefault(), t.key.toLowerCase() === "z" && !t.shiftKey ? J(S, C) : J(C, S));
	};
	me.addEventListener("keydown", he);
	let _e = () => {
		I.resize(), L.fit(), Y();
	};
	return {
		data: c,
		times: b,
		stage: I,
		observed: [R],
		resize: _e,
		redraw: Y,
		opened() {
			_e(), fe(), I.choose(l.chosen);
		},
		set: () => void 0,
		show: () => void 0,
		text: ae,
		pose: q,
		sketch: y,
		remove: () => me.removeEventListener("keydown", he)
	};
}
// src/reading.ts
var Z = class extends Error {}, Q = (e, t) => e.replace(/\{(\w+)\}/g, (e, n) => t[n] ?? e);
function $(e) {
	if (/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(e)) return e;
	let t = e.includes("'") && !e.includes("\"") ? "\"" : "'", n = t + e.replace(/\\/g, "\\\\") + t;
	return n.length <= 60 ? n : n.slice(0, 57) + "...";
}
var Ht = {
	"²": "^2",
	"³": "^3",
	"·": "*",
	"⋅": "*",
	"×": "*",
	"−": "-"
}, Ut = class {
	text;
	reading;
	units;
	tokens;
	constructor(e, t, n) {
		this.text = e, this.reading = t, this.units = n;
		let r = e.replace(/[²³·⋅×−]/g, (e) => Ht[e]).replaceAll("**", "^");
		r = r.replace(/\b(ft|in)-lb\b/g, "$1*lbf").replace(/\blb-(ft|in)\b/g, "lbf*$1").replace(/(?<=[a-zµμ])[-.](?=[a-zµμ])/gi, "*"), this.tokens = r.match(/\d+|[a-zµμ_]+|[°%]|[-*/^()]|\S/gi) ?? [];
	}
	read() {
		let e = this.product(1);
		return this.tokens.length && this.refuse(`unexpected ${$(this.tokens[0])}`), e;
	}
	refuse(e) {
		throw new Z(Q(this.reading.sentences.form, {
			unit: $(this.text),
			why: e
		}));
	}
	product(e) {
		let t = {
			up: 1,
			down: 1,
			dimension: [
				0,
				0,
				0,
				0
			]
		};
		for (this.tokens[0] === "1" && this.tokens[1] === "/" ? this.tokens.shift() : t = this.factor(1, t, e); this.tokens.length && this.tokens[0] !== ")";) {
			let n = this.tokens[0] === "/" ? -1 : 1;
			/[*/]/.test(this.tokens[0]) && this.tokens.shift(), t = this.factor(n, t, e);
		}
		return t;
	}
	factor(e, t, n) {
		let r = this.tokens.shift(), i;
		if (r === "(" && n < 5) i = this.product(n + 1), this.tokens.shift() !== ")" && this.refuse("a bracket is not closed");
		else if (r !== void 0 && /^[a-zµμ_°%]/i.test(r)) i = this.named(r);
		else return this.refuse(r === void 0 ? "a name is missing" : `expected a name, not ${$(r)}`);
		let a = 1;
		if (this.tokens[0] === "^") {
			this.tokens.shift();
			let e = this.tokens[0] === "-" && this.tokens.shift() !== void 0, t = this.tokens.shift() ?? "";
			if (!/^[1-6]$/.test(t)) throw new Z(Q(this.reading.sentences.power, { unit: $(this.text) }));
			a = e ? -t : +t;
		}
		let [o, s] = e * a < 0 ? [i.down, i.up] : [i.up, i.down];
		return {
			up: t.up * o ** Math.abs(a),
			down: t.down * s ** Math.abs(a),
			dimension: t.dimension.map((t, n) => t + e * a * i.dimension[n])
		};
	}
	named(e) {
		let t = Object.hasOwn(this.reading.units, e) ? this.reading.units[e] : null;
		if (!t) throw new Z(Q(this.reading.sentences.no_unit, {
			unit: $(e),
			units: this.units
		}));
		let [n, r, ...i] = t;
		return {
			up: n,
			down: r,
			dimension: i
		};
	}
};
function Wt(e, t, n) {
	let { kinds: r, sentences: i } = n, a = r[t.kind] ?? r.number, o = e.trim(), s = /^([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)\s*(.*)$/is.exec(o.replaceAll("−", "-")), c = {
		text: $(o),
		phrase: a.phrase,
		remedy: a.remedy
	}, l = (e, t = {}) => {
		throw new Z(Q(e, {
			...c,
			...t
		}));
	};
	if (!s) return l(i.number);
	let [, u, d] = s;
	if (/^,\s*\d/.test(d)) return l(i[/^,\d{3}(?!\d)/.test(d) ? "thousands" : "comma"], {
		point: o.replace(",", "."),
		plain: o.replaceAll(",", "")
	});
	if (/^[\d/]/.test(d) && !/^1\/[^\W\d]/.test(d)) return l(i.several);
	let f = (e) => Number.isFinite(e) ? e : l(i.finite);
	if (!d || d === t.unit) return f(+u * t.size);
	let p = new Ut(d, n, a.units).read(), m = [...p.dimension];
	if (a.per_radian && m[3] === 0 && (m[3] = a.dimension[3]), m.some((e, t) => e !== a.dimension[t])) {
		let e = Object.values(r).find((e) => e.dimension.every((e, t) => e === p.dimension[t]))?.phrase ?? Gt(p.dimension);
		if (/\blb\b/.test(d) && a.force) return l(i.dimension, {
			given: e,
			remedy: Q(i.pounds.split("; ")[1], { unit: d.replaceAll("lb", "lbf") })
		});
		let n = t.kind === "angular_speed" && String(p.dimension) === "0,0,-1,0";
		return l(i.dimension, {
			given: e,
			...n ? { remedy: i.hertz.split("; ").slice(1).join("; ") } : {}
		});
	}
	return f(+u * p.up / p.down);
}
function Gt(e) {
	return `in ${[
		"m",
		"kg",
		"s",
		"rad"
	].flatMap((t, n) => e[n] ? [t + (e[n] === 1 ? "" : `^${e[n]}`)] : []).join("*")}`;
}
// src/gate.ts
var Kt = class {
	data;
	kernel;
	sentence = "";
	accepted;
	out;
	constructor(e, t) {
		this.data = e, this.kernel = t, this.accepted = t.values.slice(), this.out = new Float64Array(t.here.length), e.limits.length && t.at(0);
	}
	type(e, t) {
		let n = this.data.numbers[e];
		try {
			let r = Wt(t, n, this.data.reading);
			this.check(n, r, $(t.trim())), this.kernel.values[e] = r;
		} catch (e) {
			if (!(e instanceof Z)) throw e;
			return e.message;
		}
		let r = this.pass() ? "" : this.sentence;
		return this.sentence = "", r;
	}
	pass() {
		let { numbers: e } = this.data, t = this.kernel.values;
		return this.sentence = "", e.forEach((e, n) => {
			if (t[n] !== this.accepted[n]) {
				e.range && Number.isFinite(t[n]) && (t[n] = Math.min(Math.max(t[n], Math.min(e.range[0], e.value)), Math.max(e.range[1], e.value)));
				try {
					this.check(e, t[n], this.words(e, t[n]));
				} catch (t) {
					this.sentence ||= `${e.label}: ${t.message}`;
				}
			}
		}), this.sentence ||= this.following(), this.sentence ? t.set(this.accepted) : this.accepted.set(t), !this.sentence;
	}
	change(e) {
		let t = this.kernel.values, { numbers: n } = this.data, r = "";
		this.accept(Float64Array.from(n, (e) => e.value)), n.forEach((n, i) => {
			e[n.path] === void 0 || Number.isNaN(e[n.path]) || (t[i] = e[n.path], this.pass() || (r ||= this.sentence));
		});
		let i = this.data.sketch.assembly.map((t) => e[t]);
		this.kernel.motion.assume(i.length && i.every(Number.isFinite) ? i : null), this.sentence = r;
	}
	accept(e) {
		this.kernel.values.set(e), this.accepted.set(e), this.sentence = "";
	}
	check(e, t, n) {
		let { sentences: r, signs: i } = this.data.reading, a = e.range;
		if (!Number.isFinite(t)) throw new Z(Q(r.finite, { text: n }));
		if (e.sign && (t < 0 || e.sign === "positive" && t === 0)) throw new Z(Q(i[e.sign], { text: n }));
		if (a && t !== e.value && (t < a[0] || t > a[1])) throw new Z(Q(r.range, {
			text: n,
			low: this.words(e, a[0]),
			high: this.words(e, a[1])
		}));
	}
	following() {
		let { limits: e, reading: t } = this.data, n = this.kernel.values;
		if (!e.length || n.every((e, t) => e === this.accepted[t])) return "";
		this.kernel.other(n, this.out);
		for (let { row: n, path: r, sign: i } of e) {
			let e = this.out[n], a = r.lastIndexOf(".");
			if (e < 0 || i === "positive" && e === 0) {
				let n = Number.isInteger(e) ? e.toFixed(1) : String(e);
				return `${r.slice(0, a)}: ${r.slice(a + 1)}: ${Q(t.signs[i], { text: n })}`;
			}
		}
		return "";
	}
	words(e, t) {
		return `${i(t / e.size, 6).replace("–", String(t))}${e.unit === "°" ? "" : " "}${e.unit}`.trim();
	}
};
// src/handles.ts
function qt(e, n, r, i) {
	let a = t("g", e.svg, { class: "handles" }), o = n.handles.map((t) => Xt(a, e, t, r, i));
	return () => r.finite && o.forEach((e) => e());
}
var Jt = (e, t) => e.reduce((e, n, r) => e + n * t[r], 0);
function Yt(e, t, n, r, [i, a]) {
	let o = e.values, s = new Float64Array(e.here.length), c = o.slice(), l = () => {
		e.other(c, s);
		let r = t.seen(n, (e) => s[e]), o = [i - r[0], a - r[1]];
		return Number.isFinite(o[0] + o[1]) ? o : null;
	};
	for (let e = 0; e < 4; e++) {
		c.set(o);
		let e = l();
		if (!e) return;
		let t = r.map((t) => {
			let n = 1e-6 * (Math.abs(o[t]) || 1);
			c[t] = o[t] + n;
			let r = l();
			return c[t] = o[t], r ? [(e[0] - r[0]) / n, (e[1] - r[1]) / n] : [0, 0];
		}), n = r.map((e) => Math.abs(o[e]) || 1), i = 0, a = 0, s = 0;
		t.forEach(([e, t], r) => (i += (e * n[r]) ** 2, a += e * t * n[r] ** 2, s += (t * n[r]) ** 2));
		let u = 1e-9 * (i + s) + 1e-300, d = (i + u) * (s + u) - a * a, f = [((s + u) * e[0] - a * e[1]) / d, ((i + u) * e[1] - a * e[0]) / d];
		for (let i = 1; i > .05; i /= 2) {
			r.forEach((e, r) => c[e] = o[e] + i * n[r] ** 2 * (t[r][0] * f[0] + t[r][1] * f[1]));
			let a = l();
			if (a && Math.hypot(...a) < Math.hypot(...e)) {
				r.forEach((e) => o[e] = c[e]);
				break;
			}
		}
	}
}
function Xt(n, i, a, o, c) {
	let l = `${{
		joint: "joint",
		point: "point",
		center: "",
		load: "force",
		direction: "direction of"
	}[a.kind]} ${a.name}`.trim(), u = t("circle", n, {
		class: `handle ${a.kind}`,
		r: a.kind === "joint" ? 2.6 : 2,
		tabindex: 0,
		role: "slider",
		"aria-label": `move ${l}`,
		"aria-valuetext": l,
		"aria-valuenow": 0,
		"data-kind": a.kind,
		"data-name": a.name,
		"data-item": a.kind === "center" ? `center:${a.name.split(":")[0]}` : `${a.kind}:${a.name}`
	});
	t("title", u).textContent = `drag ${l}`;
	let d = i.paper, f = o.values, p = (e) => e.map((e) => o.here[e]), m = [], h = [], g = [0, 0], _ = [], v = [], y = [0, 0], b = !1, x = () => {
		let e = d.point(a.p), t = "f" in a ? d.here(a.f) : "along" in a ? d.here(a.along) : [0, 0], n = a.kind === "direction" ? 16 : 1 / i.force();
		return [e[0] + n * t[0], e[1] - n * t[1]];
	}, S = () => {
		let e = (e, t) => ({
			axes: e.map(p),
			at: p(t)
		});
		m = "ends" in a ? a.ends.map((t) => e(t.axes, t.at)) : [e(a.axes, a.p)], [h, g, _, b] = [
			p(a.p),
			x(),
			"f" in a ? p(a.f) : [],
			!0
		], v = "about" in a && a.about ? p(a.about) : [];
	}, C = (e) => d.vector([e[0] - g[0], e[1] - g[1]]), w = (e) => {
		if ("by" in a && a.by) Yt(o, d, a.p, a.by, d.metres(e));
		else if ("ends" in a) E(a.ends, T(C(e)));
		else if (a.kind === "direction") {
			let t = d.point(a.p), n = [e[0] - t[0], t[1] - e[1]], [r, i] = m[0].axes.map((e) => Jt(e, n));
			f[a.direction] = Zt(Math.atan2(i, r), f[a.direction]);
		} else D(a, C(e).map((e, t) => _[t] + e / d.perMm * i.force()));
		c.changed();
	}, T = (e) => {
		if (!("about" in a) || !a.about) return e;
		let t = v, n = h.map((e, n) => e - t[n]), r = n.map((t, n) => t + e[n]), i = Math.hypot(...n) / (Math.hypot(...r) || 1);
		return r.map((e, n) => t[n] + i * e - h[n]);
	}, E = (e, t) => e.forEach((e, n) => {
		let r = h.map((e, r) => e + t[r] - m[n].at[r]);
		e.n.forEach((e, t) => f[e] = Jt(m[n].axes[t], r));
	}), D = (e, t) => {
		let n = m[0].axes.map((e) => Jt(e, t));
		if (e.components) return e.components.forEach((e, t) => f[e] = n[t]);
		let r = Math.sign(f[e.size]) || 1;
		e.direction === void 0 ? f[e.size] = r * Jt(t, _) / (Math.hypot(..._) || 1) : (f[e.direction] = Zt(Math.atan2(r * n[1], r * n[0]), f[e.direction]), f[e.size] = r * Math.hypot(...n));
	}, O = () => {
		b && c.finished(), b = !1;
	};
	return u.addEventListener("pointerdown", (e) => {
		if (e.button !== 0) return;
		e.stopPropagation(), u.setPointerCapture(e.pointerId), S();
		let t = s(i.svg, e);
		y = [g[0] - t[0], g[1] - t[1]];
	}), u.addEventListener("pointermove", (e) => {
		let t = s(i.svg, e);
		b && w([t[0] + y[0], t[1] + y[1]]);
	}), u.addEventListener("pointerup", O), u.addEventListener("pointercancel", O), u.addEventListener("keydown", (e) => {
		let t = {
			ArrowLeft: [-1, 0],
			ArrowRight: [1, 0],
			ArrowUp: [0, -1],
			ArrowDown: [0, 1]
		};
		if (!t[e.key]) return;
		e.preventDefault(), e.stopPropagation(), S();
		let n = e.shiftKey ? 5 : 1;
		w([g[0] + n * t[e.key][0], g[1] + n * t[e.key][1]]), O();
	}), () => {
		if (a.kind === "direction" && b) return;
		let [t, n] = x();
		e(u, {
			visibility: Number.isFinite(t + n) ? "visible" : "hidden",
			cx: r(t),
			cy: r(n)
		});
	};
}
var Zt = (e, t) => e - 2 * Math.PI * Math.round((e - t) / (2 * Math.PI)), Qt = 1, $t = 1e60, en = class {
	table;
	breaks;
	pieces;
	constructor(e) {
		this.table = e, this.breaks = U(e.breaks), this.pieces = U(e.pieces);
	}
	at(e) {
		let { breaks: t, pieces: n } = this, r = t.length - 1, { period: i, order: a } = this.table, o = t[0], s = i ? o + ((e - o) % i + i) % i : Math.min(Math.max(e, o), t[r]), c = 0, l = r - 1;
		for (; c < l;) {
			let e = c + l + 1 >> 1;
			t[e] <= s ? c = e : l = e - 1;
		}
		let u = 0;
		for (let e = 0; e < a; e++) u = u * (s - t[c]) + n[e * r + c];
		return u;
	}
}, tn = class e {
	data;
	whole;
	one;
	slope;
	rows;
	row;
	count;
	here;
	hereAfter;
	after;
	side;
	finite = !0;
	coarse = !1;
	good;
	refused = "";
	cyclic;
	values;
	positions;
	motion;
	open = [];
	read;
	later;
	channels;
	followed;
	known;
	constructor(e, t, n, r, i, a) {
		this.data = e, this.whole = t, this.one = n, this.slope = a, this.count = e.kernel.count, this.row = e.kernel.row, this.values = t.values, this.values.set(e.numbers.map((e) => e.value)), this.rows = t.out, this.good = new Uint8Array(this.count), this.here = new Float64Array(e.kernel.outputs + 1), this.hereAfter = new Float64Array(e.kernel.outputs + 1), this.side = e.kernel.channels.indexOf("side"), this.after = this.side < 0 ? this.rows : this.rows.slice(), [this.read, this.later] = [this.rows, this.after], this.positions = new Map(e.drives.map((e) => [e.name, U(e.position)])), this.channels = new Map(e.channels.map((e) => [e.name, {
			values: U(e.values),
			pieces: e.table && new en(e.table),
			drive: e.table ? e.table.drive : e.name.replace(/^position /, "")
		}]));
		let o = /* @__PURE__ */ new Set([...e.sketch.branches, ...e.sketch.known]);
		this.followed = e.kernel.channels.flatMap((e, t) => o.has(e) || e.startsWith("phase ") ? [{
			name: e,
			channel: t
		}] : []), this.known = new Map(e.sketch.known.map((t, n) => [t, e.sketch.branches.length + n])), e.kernel.channels.forEach((e, n) => {
			let r = this.channels.get(e).values;
			for (let e = 0; e < this.row; e++) t.path[n * this.row + e] = r[Math.min(e, this.count - 1)];
		}), this.side >= 0 && t.path.fill(-1, this.side * this.row, (this.side + 1) * this.row);
		let s = (e) => this.channels.get(e)?.values ?? new Float64Array(this.count);
		this.motion = new I(e, this, r, i, this.values, s), this.cyclic = !e.only_at_positions && e.drives.some((e) => e.turns && this.isWholeTurn(e.name));
	}
	static async create(t) {
		let n = t.numbers.length, [r, i, a, o, s] = await Promise.all([
			W.create(t.kernel, n),
			W.create(t.kernel, n),
			W.create(t.sketch.closure, n),
			W.create(t.sketch.shown, n),
			t.gradient ? W.create(t.gradient, n) : void 0
		]);
		return new e(t, r, i, a, o, s);
	}
	isWholeTurn(e) {
		let t = this.positions.get(e);
		if (t.length < 8) return !1;
		let n = (t[t.length - 1] - t[0]) * t.length / (t.length - 1) / (2 * Math.PI);
		return Math.abs(n) > .5 && Math.abs(n - Math.round(n)) < 1e-6;
	}
	get end() {
		return this.cyclic ? this.count : this.count - 1;
	}
	position(e, t) {
		let n = this.positions.get(e), [r, i] = this.split(t);
		if (i === 0 || n.length < 2) return n[r];
		let a = r + 1 < n.length ? n[r + 1] : this.isWholeTurn(e) ? n[r] + (n[1] - n[0]) : n[0];
		return n[r] + i * (a - n[r]);
	}
	split(e) {
		let t = Math.min(Math.floor(e), this.count - 1);
		return e >= this.count ? [0, 0] : [t, e - t];
	}
	input(e, t) {
		let n = this.channels.get(e), [r, i] = this.split(t);
		if (e.startsWith("position ")) return this.position(e.slice(9), t);
		if (n.pieces && i !== 0) return n.pieces.at(this.position(n.drive, t));
		let a = n.values[r + 1 < this.count ? r + 1 : 0];
		return i === 0 ? n.values[r] : n.values[r] + i * (a - n.values[r]);
	}
	cycle() {
		this.motion.update() || this.closes(), this.side >= 0 && this.bothSides();
		let e = this.rows.length - this.row;
		for (let t = 0; t < this.count; t++) this.rows[e + t] = this.motion.poses[t] ? this.judged(this.rows[e + t], (e) => this.rows[e * this.row + t]) : Qt, this.good[t] = +this.numbered(this.markAt(t));
	}
	closes() {
		for (let { name: e, channel: t } of this.followed) this.whole.path.set(this.channels.get(e).values, t * this.row);
		return this.whole.call(this.count), Uint8Array.from({ length: this.count }, (e, t) => +(this.markAt(t) !== Qt));
	}
	bothSides() {
		let { path: e, out: t } = this.whole, n = this.side * this.row, r = t.slice();
		e.fill(1, n, n + this.row), this.whole.call(this.count), this.after.set(t), t.set(r), e.fill(-1, n, n + this.row);
		let i = t.length - this.row;
		for (let e = 0; e < this.count; e++) t[i + e] = this.between(t[i + e], this.after[i + e], (n) => t[n * this.row + e] === this.after[n * this.row + e]);
	}
	between(e, t, n) {
		return e === t ? this.numbered(e) && !this.here.every((e, t) => t === this.here.length - 1 || n(t)) && e === 0 ? this.marked("reversal") : e : this.numbered(e) ? t : e;
	}
	judged(e, t) {
		if (e === Qt || !this.numbered(e) && this.data.statuses[e].status !== "undecided") return e;
		let n = this.numbered(e) || this.values.some((e) => Math.abs(e) > $t);
		for (let e = 0; n && e < this.here.length - 1; e++) if (!Number.isFinite(t(e))) return this.marked("overflow");
		return e;
	}
	marked(e) {
		return this.data.statuses.findIndex((t) => t.status === e);
	}
	closesAt(e) {
		return this.run(e, null, this.motion.otherwise), this.one.at(this.here.length - 1) !== Qt;
	}
	posed(e) {
		return this.data.sketch.poses.map((t) => t.map((t) => this.value(t, e)));
	}
	get stepped() {
		return this.data.only_at_positions;
	}
	drives(e) {
		return this.data.drives.map((t) => this.position(t.name, e));
	}
	at(e) {
		let t = this.motion.at(e), { here: n } = this;
		this.run(e, t, t ? this.motion.read(t, e) : this.motion.otherwise);
		for (let e = 0; e < n.length; e++) [n[e], this.hereAfter[e]] = [this.one.at(e), this.one.at(e, 1)];
		let r = n.length - 1, i = this.side >= 0 ? this.between(n[r], this.hereAfter[r], (e) => n[e] === this.hereAfter[e]) : n[r];
		n[r] = this.judged(i, (e) => n[e]), t || (n[n.length - 1] = Qt), this.open = [], t && n.every(Number.isFinite) || this.stretch(t ?? this.motion.stretched(e), e), this.finite = this.data.sketch.drawn.every((e) => Number.isFinite(n[e]));
	}
	stretch(e, t) {
		let { sketch: n } = this.data, r = this.motion.look(e, t, this.motion.otherwise), i = n.branches.length + n.known.length;
		n.drawn.forEach((e, t) => this.here[e] = r.at(i + t));
		let a = (e) => e.map((e) => r.at(e)), o = n.gaps.map((e) => ({
			joint: e.joint,
			p: a(e.p),
			q: a(e.q)
		})), s = o.map((e) => Math.hypot(...e.p.map((t, n) => t - e.q[n]))), c = Math.max(1e-6 * n.length, .02 * Math.max(...s));
		this.open = o.filter((e, t) => s[t] > c);
	}
	run(e, t, n) {
		this.feed(this.one, this.data.kernel.channels, e, t, n), this.one.values.set(this.values), this.one.call(1);
	}
	feed(e, t, n, r, i) {
		let a = r && this.data.sketch.known.length ? this.motion.look(r, n, i) : null;
		t.forEach((t, r) => {
			let o = this.data.sketch.branches.indexOf(t), s = this.known.get(t);
			if (t === "side") return e.put(r, -1, 1);
			e.put(r, o >= 0 ? i[o] : s === void 0 ? this.input(t, n) : a?.at(s) ?? NaN);
		});
	}
	other(e, t) {
		this.one.values.set(e), this.one.call(1);
		for (let e = 0; e < t.length; e++) t[e] = this.one.at(e);
	}
	gradient(e, t) {
		let n = this.data.gradient, r = this.slope, i = this.motion.poses[t];
		this.feed(r, n.channels, t, i, Float64Array.from(this.motion.branches, (e) => e[t])), r.values.set(this.values), r.call(1);
		let a = n.numbers.length;
		return Float64Array.from({ length: a }, (t, n) => r.at(e * a + n));
	}
	numbered(e) {
		return !this.refused && this.data.statuses[e].numbered;
	}
	state() {
		return Float64Array.from([...this.values, ...this.motion.state()]);
	}
	restore(e) {
		let t = this.values.length;
		this.values.set(e.subarray(0, t)), this.motion.restore([...e.subarray(t)]);
	}
	get mark() {
		return this.here[this.here.length - 1];
	}
	get solved() {
		return this.numbered(this.mark);
	}
	markAt(e) {
		return this.rows[this.rows.length - this.row + e];
	}
	value(e, t) {
		return this.read[e * this.row + t];
	}
	reverses(e) {
		return this.side >= 0 && this.data.statuses[this.markAt(e)].status === "reversal";
	}
	onceAfter(e) {
		[this.read, this.later] = [this.later, this.read];
		try {
			return e();
		} finally {
			[this.read, this.later] = [this.later, this.read];
		}
	}
	largest(e) {
		let t = 0;
		for (let n = 0; n < this.count; n++) this.good[n] && (t = Math.max(t, e(n), this.reverses(n) ? this.onceAfter(() => e(n)) : 0));
		return t;
	}
};
// src/panels.ts
function nn(e, t, r, i, a) {
	let o = [], s = /* @__PURE__ */ new Map(), c = (t) => {
		let r = s.get(t);
		if (!r) {
			let i = n("fieldset", e);
			n("legend", i, {}, t), s.set(t, r = i);
		}
		return r;
	}, l = t.numbers.map((e, t) => ({
		field: e,
		n: t
	})).sort((e, t) => Number(t.field.parameter ?? !1) - Number(e.field.parameter ?? !1));
	for (let { field: e, n: t } of l) {
		let [s, l] = e.parameter ? ["Parameters", e.label] : rn(e.label), f = n("label", c(s), { title: e.about ?? e.path });
		n("span", f, {}, l);
		let p = n("input", f, {
			type: "text",
			inputmode: "decimal",
			autocomplete: "off",
			spellcheck: "false",
			"aria-label": e.label,
			"data-path": e.path
		});
		n("span", f, { class: "unit" }, e.unit);
		let m = n("span", f, {
			class: "wrong",
			role: "alert"
		}), h = {
			box: p,
			n: t,
			field: e
		}, g = (e) => {
			m.textContent = e, p.toggleAttribute("aria-invalid", !!e);
		};
		if (p.addEventListener("change", () => {
			if (p.value.trim() === "" || p.value === u(h)) return g(""), d(h);
			let e = i.type(t, p.value);
			g(e), e || (p.value = u(h), a(!0));
		}), p.addEventListener("keydown", (e) => {
			e.key === "Escape" && (g(""), p.value = u(h), p.blur());
		}), e.parameter) {
			let [i, o] = e.range ?? an(e.value), s = n("input", f, {
				type: "range",
				min: i / e.size,
				max: o / e.size,
				step: "any",
				"aria-label": `${e.label}, slider`
			});
			h.slide = s;
			let c = (n) => () => {
				r.values[t] = +s.value * e.size, a(n);
			};
			s.addEventListener("input", c(!1)), s.addEventListener("change", c(!0));
		}
		o.push(h);
	}
	let u = (e) => String(+(r.values[e.n] / e.field.size).toPrecision(6)), d = (e) => {
		let t = r.values[e.n] / e.field.size;
		document.activeElement !== e.box && !e.box.hasAttribute("aria-invalid") && (e.box.value = u(e)), e.slide && document.activeElement !== e.slide && (e.slide.value = String(t)), e.box.classList.toggle("changed", r.values[e.n] !== e.field.value);
	};
	return {
		update: () => o.forEach(d),
		focus: (e) => o.find((t) => t.field.path === e)?.box.focus()
	};
}
function rn(e) {
	let t = e.indexOf(": ");
	return t < 0 ? ["Others", e] : [e.slice(0, t), e.slice(t + 2)];
}
function an(e) {
	let t = .5 * Math.abs(e) || 1;
	return [e - t, e + t];
}
function on(e, t, r) {
	let a = n("tbody", n("table", e, { class: "answers" })), o = t.views.table.map((e) => {
		let r = n("tr", a), i = t.units[e.kind];
		return n("th", r, { scope: "row" }, l(e.name)), {
			r: e,
			unit: i,
			cell: n("td", r)
		};
	});
	return { update() {
		for (let { r: e, unit: t, cell: n } of o) {
			let a = e.rows.map((e) => r.here[e] / t.size), o = (e) => t.unit === "°" ? `${i(e, 5)}°` : `${i(e)} ${t.unit}`;
			n.textContent = r.solved ? a.length === 1 ? o(a[0]) : `${o(Math.hypot(...a))}${a.length === 2 ? ` at ${i(Math.atan2(a[1], a[0]) * 180 / Math.PI)}°` : ""}  (${a.map((e) => i(e)).join(", ")})` : "–";
		}
	} };
}
function sn(e, t, r, a) {
	let { terms: o, about: s } = a.equations, { force: c, moment: u } = t.units, d = o[0]?.f.length ?? 2, f = [
		"x",
		"y",
		"z"
	].slice(0, d).map((e, t) => ({
		head: `ΣF${e}`,
		unit: c,
		sign: (t) => l(t.name) + e,
		row: (e) => e.f[t]
	}));
	(d === 2 ? [""] : [
		"x",
		"y",
		"z"
	]).forEach((e, t) => f.push({
		head: `ΣM${e} about ${s}`,
		unit: u,
		sign: (t) => `M${e}(${l(t.name)})`,
		row: (e) => e.m[t]
	}));
	let p = f.map((t) => ({
		sum: t,
		el: n("p", e, { class: "equation" })
	}));
	return { update() {
		for (let { sum: e, el: t } of p) {
			let n = o.map((t) => r.here[e.row(t)] / e.unit.size), a = Math.max(...n.map(Math.abs), 0), s = n.map((e, t) => ({
				v: e,
				k: t
			})).filter((e) => Math.abs(e.v) > 1e-9 * a);
			if (!r.solved || !s.length) {
				t.textContent = `${e.head}: ${r.solved ? "nothing acts" : "no answer here"}`;
				continue;
			}
			let c = s.map((t) => e.sign(o[t.k])).join(" + "), l = s.reduce((e, t) => e + t.v, 0), u = s.map((e, t) => (e.v < 0 ? t ? " − " : "−" : t ? " + " : "") + i(Math.abs(e.v))).join("");
			t.textContent = `${e.head}: ${c} = ${u} = ${i(Math.abs(l) < 1e-9 * a ? 0 : l)} ${e.unit.unit}`;
		}
	} };
}
function cn(e, t) {
	n("p", e, {}, "One linear system per position gives forces and motion (D'Alembert's principle); everything shown is recomputed from the numbers beside it, in double precision.");
	let r = n("dl", e);
	for (let [e, i] of Object.entries(t.assumptions)) n("dt", r, {}, e), n("dd", r, {}, i);
	t.source && n("p", e, {}, `Source: ${t.source}`), n("p", e, {}, `Made with dalembert ${t.version}.`);
}
// src/charts.ts
var ln = 16, un = 5, dn = 8, fn = 4;
function pn(e, t) {
	let n = e / t || 1, r = 10 ** Math.floor(Math.log10(n));
	return r * ([
		1,
		2,
		5,
		10
	].find((e) => e * r >= n) ?? 10);
}
function mn(e, t) {
	return [
		1,
		2,
		5,
		10,
		15,
		30,
		45,
		60,
		90,
		180,
		360
	].find((n) => n >= e / t) ?? 360 * pn(e / 360, t);
}
function hn(e, t, n) {
	let r = Math.ceil(e / n - 1e-9), i = Math.floor(t / n + 1e-9) - r + 1;
	return Array.from({ length: Math.max(i, 0) }, (e, t) => (r + t) * n);
}
function gn(a, o, l, u, d, p) {
	let m = n("figure", a, { class: "chart" }), h = o.units[u.kind];
	n("figcaption", m, {}, `${u.title}, ${h.unit}`);
	let g = o.views.charts.flatMap((e) => e.curves.map((e) => f(e.name, 3))), _ = Math.max(44, 13 + fn * u.curves.length), v = ot(m, p, _, u.title), y = _ - un - dn, b = -_ / 2 + un, x = 0, S = 0, C = t("path", v, {
		class: "l-grid",
		style: "fill:none"
	}), w = t("path", v, {
		class: "l-axis",
		style: "fill:none"
	}), T = t("g", v), E = u.curves.map((e) => t("path", v, {
		class: `l-${e.role}`,
		style: "fill:none"
	})), D = t("path", v, { class: "cursor" }), O = u.curves.map((e) => t("circle", v, {
		class: `l-${e.role}-h`,
		r: .9
	})), k = Math.max(l.count - 1, 1), A = o.noise[u.kind] ?? 0, j = u.curves.map((e, n) => {
		let r = t("text", v, {
			class: `l-${e.role}-t key`,
			"font-size": 3,
			y: b + 3 + fn * n,
			tabindex: 0,
			role: "button"
		});
		return c(r, e.name, 3), t("title", r).textContent = "show what lowers its peak", r.addEventListener("click", () => d.pick(e)), r.addEventListener("keydown", (t) => t.key === "Enter" && d.pick(e)), r;
	}), M = (e, t) => {
		let n = l.value(e.row, t) / h.size;
		return Math.abs(n) * h.size < A ? 0 : n;
	}, N = NaN, P = NaN, F = 1, I = (e) => S + e / k * x, L = (e) => b + y - (e - N) / (P - N) * y;
	function R() {
		let [e, t] = [Infinity, -Infinity];
		for (let n of u.curves) for (let r = 0; r < l.count; r++) if (l.good[r]) {
			let i = M(n, r), a = l.reverses(r) ? l.onceAfter(() => M(n, r)) : i;
			e = Math.min(e, i, a), t = Math.max(t, i, a);
		}
		return e <= t || ([e, t] = [0, 1]), e > 0 && e < .4 * t && (e = 0), t < 0 && t > .4 * e && (t = 0), t - e < 1e-9 * Math.max(Math.abs(t), Math.abs(e), 1e-9) && ([e, t] = [Math.min(e, 0), Math.max(t, 0) || 1]), F = pn(t - e, 4), [e, t] = [Math.floor(e / F + 1e-9) * F, Math.ceil(t / F - 1e-9) * F], e === N && t === P ? !1 : ([N, P] = [e, t], !0);
	}
	function z() {
		let e = o.drives[0], n = (e, n, r, i) => t("text", T, {
			class: "l-note-t",
			"font-size": 2.6,
			"text-anchor": i,
			x: n,
			y: r
		}).textContent = e;
		T.replaceChildren();
		let a = "";
		for (let e of hn(N, P, F)) a += `M${S} ${r(L(e))}h${x}`, n(i(e, 5), S - 1.2, L(e) + .9, "end");
		if (e) {
			let [t, o] = [0, k].map((t) => l.position(e.name, t) / e.size);
			for (let s of hn(Math.min(t, o), Math.max(t, o), (e.unit === "°" ? mn : pn)(Math.abs(o - t), 6))) {
				let c = S + (s - t) / (o - t || 1) * x;
				a += `M${r(c)} ${b}v${y}`, n(i(s, 5) + (e.unit === "°" ? "°" : ""), c, b + y + 3.4, "middle");
			}
			n(`${e.name}, ${e.unit}`, S + x, b + y + 6.6, "end");
		}
		C.setAttribute("d", a), w.setAttribute("d", `M${S} ${b}v${y}` + (N < 0 && P > 0 ? `M${S} ${r(L(0))}h${x}` : ""));
	}
	function B(e) {
		p = e, [x, S] = [p - ln - Math.min(Math.max(...g) + 4, .3 * p), -p / 2 + ln], v.setAttribute("viewBox", `${-p / 2} ${-_ / 2} ${p} ${_}`), j.forEach((e) => e.setAttribute("x", r(S + x + 2))), N = NaN;
	}
	B(p);
	let V = (e) => d.seek((s(v, e)[0] - S) / x * k);
	return v.addEventListener("pointerdown", (e) => {
		e.target.closest(".key") || (v.setPointerCapture(e.pointerId), V(e));
	}), v.addEventListener("pointermove", (e) => e.buttons && v.hasPointerCapture(e.pointerId) && V(e)), {
		resize: B,
		update(t) {
			t && (R() && z(), E.forEach((e, t) => Pe(e, Fe(l, (e) => [I(e), L(M(u.curves[t], e))]))));
			let n = r(I(Math.min(d.time(), k)));
			D.setAttribute("d", `M${n} ${b}v${y}`), u.curves.forEach((t, i) => {
				let a = l.solved ? {
					cx: n,
					cy: r(L(l.here[t.row] / h.size))
				} : {};
				e(O[i], {
					visibility: l.solved ? "visible" : "hidden",
					...a
				}), j[i].classList.toggle("picked", d.picked() === t);
			});
		}
	};
}
var _n = 1e-11;
function vn(e, r, a, o, s) {
	let c = n("figure", e, { class: "polar" }), [l, u] = a.f, d = n("figcaption", c), f = ot(c, 66, 66, `polar diagram of joint ${a.name}`);
	t("path", f, {
		class: "l-grid",
		style: "fill:none",
		d: "M-30 0H30M0 -30V30M15 0A15 15 0 1 0 -15 0A15 15 0 1 0 15 0M30 0A30 30 0 1 0 -30 0A30 30 0 1 0 30 0"
	});
	let p = t("path", f, {
		class: `l-${a.role}`,
		style: "fill:none"
	}), h = new m(f, "joint-force", a.name), g = 1, _ = !1;
	return { update(e) {
		if (e) {
			let e = (e) => r.largest((t) => Math.max(...e.map(({ f: e }) => Math.hypot(r.value(e[0], t), r.value(e[1], t)))));
			if (_ = !(e([a]) > _n * e(o)), f.setAttribute("display", _ ? "none" : "inline"), _) return void (d.textContent = `Joint ${a.name}: no force at any position`);
			let t = Ze(e([a]) / s.size);
			g = t / 30 * s.size, Pe(p, Fe(r, (e) => [r.value(l, e) / g, -r.value(u, e) / g], !0)), d.textContent = `Joint ${a.name}: circles of ${i(t / 2)} and ${i(t)} ${s.unit}`;
		}
		h.set([0, 0], r.solved && !_ ? [r.here[l] / g, -r.here[u] / g] : [0, 0]);
	} };
}
function yn(e, r, i, o, s) {
	let c = n("figure", e, { class: "polygon" }), l = r.units.force;
	n("figcaption", c, {}, o);
	let u = ot(c, 110, 80, o), d = t("g", u), f = /* @__PURE__ */ new Set(), p = s.map(({ sides: e }) => {
		let t = e.find((e) => e.kind === "joint" && f.has(e.of));
		for (let t of e) t.kind === "joint" && f.add(t.of);
		return {
			shared: t,
			drawn: e.filter((e) => e !== t).map((e) => ({
				s: e,
				arrow: new m(u, e.role, e.name),
				name: ye(d, e.role, e.name, 3)
			}))
		};
	}), h = t("path", u, {
		class: "l-gap",
		style: "fill:none"
	}), g = new at(u, !0);
	return {
		figure: c,
		update() {
			if (u.setAttribute("visibility", i.solved ? "visible" : "hidden"), !i.solved) return;
			let e = i.here, t = /* @__PURE__ */ new Map(), n = [], r = [], o = p.flatMap(({ shared: i, drawn: a }) => {
				let o = $e(n)?.y[1] ?? 0, s = t.get(i?.of ?? "") ?? [0, o], c = (t) => [s[0] + e[t[0]], s[1] - e[t[1]]], l = s;
				i && (s = c(i.f));
				let u = a.map((e) => {
					let r = s;
					return s = c(e.s.f), e.s.kind === "joint" && !t.has(e.s.of) && t.set(e.s.of, s), n.push(r, s), {
						...e,
						from: r,
						to: s
					};
				});
				return r.push([l, s]), u;
			}), s = $e(n) ?? {
				x: [0, 0],
				y: [0, 0]
			}, c = Ze(Math.max((s.x[1] - s.x[0]) / 66, (s.y[1] - s.y[0]) / 48) / l.size) * l.size, d = ([e, t]) => [(e - (s.x[0] + s.x[1]) / 2) / c, (t - (s.y[0] + s.y[1]) / 2) / c], f = new xe([
				-55,
				-40,
				55,
				36
			]);
			for (let { from: e, to: t } of o) f.line(d(e), d(t));
			for (let { arrow: e, name: t, from: n, to: r } of o) {
				let [i, a] = [d(n), d(r)], o = e.set(i, a), s = [(i[0] + a[0]) / 2, (i[1] + a[1]) / 2];
				t.el.setAttribute("visibility", o ? "visible" : "hidden"), o && f.put({
					label: t,
					anchors: [s],
					away: s,
					leave: .9
				});
			}
			h.setAttribute("d", r.map(([e, t]) => a([d(e), d(t)])).join("")), g.set([-53, 37.4], c, l);
		}
	};
}
// src/results.ts
var bn = 4.6, xn = (e) => Math.min(Math.max(e / bn, 72), 140), Sn = (e) => !e.closest("[role=tabpanel]")?.hidden && (e.closest("details")?.open ?? !0);
function Cn(e, t, r, i, a, o) {
	let { charts: s, bodies: c, polygons: l } = t.views, u = [], d = [], f = r.count > 1 ? e.add("Curves", "forces and efforts over the cycle") : null;
	for (let e of f ? s : []) u.push(gn(f, t, r, e, i, 120));
	let p = r.count > 2 ? s.flatMap((e) => e.curves).filter((e) => e.f) : [];
	if (f && p.length) {
		n("h2", f, {}, "Polar diagrams");
		for (let e of p) d.push({
			box: f,
			view: vn(f, r, e, p, t.units.force)
		});
	}
	let m = e.add("Forces", "free bodies, their equations, and force polygons"), h = n("select", m, { "aria-label": "link" }), g = c.map((e, i) => {
		n("option", h, { value: i }, `${e.title}${e.member && `, ${e.member} member`}`);
		let o = n("div", m, { class: "body" }), s = lt(o, r, e, e.about, 110, 100, t.units, `free body of ${e.title}`, a);
		return d.push({
			box: o,
			view: s,
			link: i
		}, {
			box: o,
			view: sn(o, t, r, e),
			link: i
		}), s;
	});
	if (l.links.length) {
		l.links.forEach((e, n) => {
			let i = yn(m, t, r, `Force polygon of link ${e.title}`, [e]);
			d.push({
				box: i.figure,
				view: i,
				link: n
			});
		});
		let e = l.chain.map((e) => l.links[e]);
		d.push({
			box: m,
			view: yn(m, t, r, `In the order of solution: ${e.map((e) => e.title).join(" → ")}`, e)
		});
	}
	let _ = e.add("Numbers", "the numbers of this position");
	d.push({
		box: _,
		view: on(_, t, r)
	});
	let v = () => void (a.body = c[+h.value]?.link ?? ""), y = (e) => {
		let t = c.findIndex((t) => t.link === e);
		return t >= 0 && (h.value = String(t)), v(), t >= 0;
	};
	h.addEventListener("change", () => (v(), o())), y(a.body);
	function b() {
		for (let e of g) e.fit();
		let e = Math.max(0, ...g.map((e) => e.need()));
		for (let t of g) t.fit(e || void 0);
	}
	return {
		bodies: g,
		fit: b,
		choose: y,
		resize: (e) => u.forEach((t) => t.resize(xn(e))),
		update(e) {
			for (let t of u) Sn(f) && t.update(e);
			for (let { box: t, view: n, link: r } of d) r !== void 0 && (t.hidden = r !== +h.value), (r === void 0 || r === +h.value) && Sn(t) && n.update(e);
		}
	};
}
// src/sentences.ts
function wn(e, t = 6) {
	if (!Number.isFinite(e)) return Number.isNaN(e) ? "nan" : e > 0 ? "inf" : "-inf";
	let [n, r] = e.toExponential(t - 1).split("e"), i = +r, a = (e) => e.includes(".") ? e.replace(/\.?0+$/, "") : e;
	return i < -4 || i >= t ? `${a(n)}e${i < 0 ? "-" : "+"}${String(Math.abs(i)).padStart(2, "0")}` : a(e.toFixed(Math.max(t - 1 - i, 0)));
}
var Tn = (e) => e.length < 2 ? e.join("") : `${e.slice(0, -1).join(", ")} and ${e.at(-1)}`, En = class {
	data;
	kernel;
	s;
	said = {
		key: "",
		text: ""
	};
	constructor(e, t) {
		this.data = e, this.kernel = t, this.s = e.sentences;
	}
	refusal() {
		for (let { sentence: e, rows: t, error: n } of this.s.gears) {
			let [r, i, a] = t.map((e) => this.kernel.here[e]), o = i + a;
			if (Math.abs(r - o) > n * o) return Q(e, {
				found: wn(r),
				ri: wn(Math.abs(i)),
				rj: wn(Math.abs(a)),
				wanted: wn(o)
			});
		}
		return "";
	}
	at(e) {
		let { kernel: t, s: n } = this, { status: r, sentence: i } = this.data.statuses[t.mark];
		if (t.refused) return t.refused;
		let a = n.templates[r];
		if (!a || r === "ok") return i;
		let o = this.run(e), s = [
			r,
			o,
			t.values
		].join();
		return this.said.key !== s && (this.said = {
			key: s,
			text: r === "not_assembled" ? this.open(a, o) : Q(a, this.places(r, o, e))
		}), this.said.text;
	}
	run(e) {
		let { kernel: t } = this, n = (e) => e >= 0 && e < t.count && t.markAt(e) === t.mark, r = [
			Math.round(e),
			Math.floor(e),
			Math.ceil(e)
		].find(n);
		if (r === void 0 || this.data.statuses[t.mark].status === "reversal") return [e, e];
		let [i, a] = [r, r];
		for (; n(i - 1);) i--;
		for (; n(a + 1);) a++;
		return [i, a];
	}
	places(e, t, n) {
		let r = this.arc(t), i = {
			arc: r,
			at: this.arc([t[0], t[0]]),
			side: "",
			span: r.trim() || this.s.words.described
		};
		if (e === "overflow") return {
			...i,
			whose: this.whose()
		};
		if (e === "self_locking") return {
			...i,
			figures: this.figures(t, n)
		};
		let { kernel: a, s: o } = this, s = o.unknowns.map((e) => e.name), c = o.contacts.filter((t) => e === "reversal" ? a.here[t.row] !== a.hereAfter[t.row] : a.here[t.row] === 0), l = [...new Set(c.map((e) => e.joint))], u = o.unknowns.map((e) => Q(o.words.sides, {
			name: e.name,
			before: this.quantity(a.here[e.row], e.kind),
			after: this.quantity(a.hereAfter[e.row], e.kind)
		})), d = e === "reversal" ? l.length === 1 ? "reverses" : "reverse" : s.length === 1 ? "lies in an interval" : "each lie in an interval";
		return {
			...i,
			joints: e === "reversal" ? Tn(l) : l.join(", "),
			verb: d,
			values: Tn(u),
			name: s[0] ?? "",
			names: Tn(s)
		};
	}
	figures(e, t) {
		let { kernel: n, s: r, data: i } = this, a = n.values.slice(), o = new Float64Array(n.here.length), s = i.numbers.flatMap((e, t) => /(^|\.)friction\.coefficient$/.test(e.path) ? [t] : []);
		if (!s.length || i.numbers.some((e) => e.parameter)) return "";
		for (let e of s) a[e] = 0;
		let c = -1, l = e[0], u = "";
		for (let t = e[0]; t <= e[1]; t++) {
			n.at(t), n.other(a, o);
			let e = r.unknowns.reduce((e, { row: t }) => e + Math.abs(n.here[t] - o[t]), 0);
			e > c && ([c, l] = [e, t], u = r.unknowns.map(({ name: e, kind: t, row: i }) => Q(r.words.needs, {
				name: e,
				rubbed: this.quantity(n.here[i], t),
				bare: this.quantity(o[i], t)
			})).join(", "));
		}
		return n.at(t), `;${e[0] === e[1] ? "" : this.arc([l, l])} ${u}`;
	}
	quantity(e, t, n = 6) {
		let { unit: r, size: i } = this.s.units[t];
		return `${wn(e / i, n)} ${r}`;
	}
	drive(e, t) {
		return this.quantity(this.kernel.position(e.name, t), e.turns ? "angle" : "length");
	}
	arc([e, t]) {
		let { drives: n } = this.data;
		return n.length ? e === t ? ` at ${n.map((t) => `${t.name} = ${this.drive(t, e)}`).join(" and ")}` : ` between ${n.map((n) => `${this.drive(n, e)} and ${this.drive(n, t)} of ${n.name}`).join(", ")}` : "";
	}
	open(e, [t, n]) {
		let r = t === n ? t : t + (n - t + 1 >> 1), { pose: i, gaps: a } = this.kernel.motion.open(r), o = (e) => this.s.joints.indexOf(e), s = this.arc([t, n]).trim() || this.s.words.described;
		a.sort((e, t) => o(e.joint) - o(t.joint));
		let c = this.most(a.map((e) => [e.joint, e.length]), "length", this.data.sketch.length), l = [c, this.most(a.map((e) => [e.joint, e.angle]), "angle", 1)].filter(Boolean);
		return l.length ? Q(e, {
			span: s,
			gap: `: ${t !== n && this.data.drives.length ? `${this.arc([r, r]).trim()} ` : ""}${l.join(" and ")}`,
			datum: c ? "a length" : "a direction"
		}) : this.loose(i) || Q(this.s.words.unfollowed, { span: s });
	}
	loose(e) {
		let { drives: t, sketch: n } = this.data, r = this.kernel.motion.sketch.mobility(e), i = r.freedoms - t.length;
		if (n.dimension !== 2 || i <= 0) return "";
		let a = r.joints.slice(0, 6).map((e) => `${e.joint} (${e.angular ? "turn" : "slide"})`), o = a.length ? ` at ${i === 1 ? "one" : "some"} of ${a.join(", ")}` : "", s = (e, t) => e ? `${e} ${t}${e > 1 ? "s" : ""}` : `no ${t}`;
		return `${Q(this.s.words.counts, {
			freedoms: s(r.freedoms, "freedom"),
			drives: s(t.length, "drive")
		})}; ${Q(this.s.words.add, {
			drives: s(i, "drive"),
			where: o,
			loose: r.links.join(", ")
		})}`;
	}
	most(e, t, n) {
		let { words: r, limits: i } = this.s, a = e.filter(([, e]) => e > i.shut * n);
		if (!a.length) return "";
		let [o, s] = a.reduce((e, t) => t[1] > e[1] ? t : e), c = this.quantity(s, t, 3);
		if (a.length === 1) return Q(r.one, {
			...r.kinds[t],
			joint: o,
			figure: c
		});
		let l = Math.min(...a.map(([, e]) => e)) > i.alike * s ? Q(r.alike, { joints: a.map(([e]) => e).join(", ") }) : Q(r.most, {
			joint: o,
			figure: c
		});
		return Q(r.several, {
			...r.kinds[t],
			total: this.quantity(e.reduce((e, [, t]) => e + t, 0), t, 3),
			where: l
		});
	}
	whose() {
		let { overflow: e, words: t } = this.s, n = (e) => this.kernel.here[e], r = "";
		for (let [i, a] of Object.entries(e)) {
			let o = a.filter(([, ...t]) => !t.every((t) => Number.isFinite(n(t) * n(t)) || Number.isFinite(n(t)) && i !== Object.keys(e)[0])).map(([e]) => e);
			if (o.length) return Q(t.of, {
				what: i,
				names: o.join(", ")
			});
			r = Q(t.checks, { what: i });
		}
		return r;
	}
}, Dn = 0;
function On(e, t, r) {
	let i = n("div", e, {
		class: "tabs",
		role: "tablist",
		"aria-label": "results"
	}), a = n("div", e, { class: "panels" }), o = [], s = (e, t = !1) => {
		let n = o.find((t) => t.name === e) ?? o[0];
		if (n) {
			for (let { tab: e, panel: t } of o) {
				let r = t === n.panel;
				e.setAttribute("aria-selected", String(r)), e.tabIndex = r ? 0 : -1, t.hidden = !r;
			}
			t && n.tab.focus(), a.scrollTop = 0;
		}
	}, c = (e, n = !1) => {
		t.tab = e === o[0].name ? "" : e, s(e, n), r();
	};
	return i.addEventListener("keydown", (e) => {
		let t = o.findIndex((t) => t.tab === document.activeElement || t.tab === e.target), n = o.length, r = {
			ArrowRight: (t + 1) % n,
			ArrowLeft: (t + n - 1) % n,
			Home: 0,
			End: n - 1
		}[e.key];
		t < 0 || r === void 0 || (e.preventDefault(), e.stopPropagation(), c(o[r].name, !0));
	}), {
		add(e, r = e) {
			let l = `dalembert-tab-${++Dn}`, u = n("button", i, {
				type: "button",
				role: "tab",
				id: l,
				title: r,
				"aria-controls": `${l}-panel`
			}, e), d = n("section", a, {
				role: "tabpanel",
				id: `${l}-panel`,
				"aria-labelledby": l,
				"data-tab": e,
				tabindex: 0
			});
			return o.push({
				name: e,
				tab: u,
				panel: d
			}), u.addEventListener("click", () => c(e)), s(t.tab), d;
		},
		show: (e) => c(e)
	};
}
// src/toolbar.ts
function kn(e, t, r, i, a, o) {
	let s = n("header", e);
	n("h1", s, {}, t.title);
	let c = n("div", s, {
		class: "bar",
		role: "toolbar",
		"aria-label": "cycle and page"
	}), l = (e, t, r) => {
		let i = n("button", c, {
			type: "button",
			title: t,
			.../^\w/.test(e) ? {} : { "aria-label": t }
		}, e);
		return i.addEventListener("click", r), i;
	}, u = l("▶", "play along the cycle (space)", o.play), d = n("input", c, {
		type: "range",
		min: 0,
		max: r.end,
		step: t.only_at_positions ? 1 : "any",
		"aria-label": "position in the cycle"
	}), f = n("output", c, { class: "readout" }), p = n("select", c, {
		class: "speed",
		title: "speed of play; , and . step, with Shift by ten",
		"aria-label": "speed of play"
	});
	for (let e of We) n("option", p, { value: e }, `${e}×`);
	p.value = String(a.speed), p.addEventListener("change", () => a.speed = +p.value);
	let m = l("↶", "undo (Ctrl+Z)", () => o.go(!0)), h = l("↷", "redo (Ctrl+Y)", () => o.go(!1));
	o.back && l("Back", "back to the sketch: undo the last addition", o.back), l("Reset", "all numbers as in the file", o.reset);
	let g = n("p", s, {
		class: "mark",
		role: "status"
	});
	d.addEventListener("input", () => o.show(+d.value));
	for (let e of [
		u,
		d,
		f,
		p
	]) e.hidden = r.count < 2;
	return {
		playing: (e) => u.textContent = e ? "❚❚" : "▶",
		update(e, n, a) {
			let o = [a, i.at(e)].filter(Boolean).join(" ");
			g.textContent !== o && (g.textContent = o), d.value = String(e), f.textContent = Tt(t, r, e), [m.disabled, h.disabled] = n.map((e) => !e);
		}
	};
}
// src/tracers.ts
function An(n, i, a, o) {
	let s = t("g", null, { class: "tracers" });
	n.svg.querySelector("g").before(s);
	let c = [];
	return (l) => {
		let u = o.tracers.filter((e) => i.links.includes(e.link));
		for (; c.length > u.length;) for (let e of Object.values(c.pop())) e.remove();
		u.forEach((o, u) => {
			let d = i.links.indexOf(o.link), f = !c[u];
			c[u] ??= {
				line: t("path", s, {
					class: "l-trace",
					style: "fill:none"
				}),
				dot: t("circle", s, {
					class: "l-trace tracer",
					r: 1.1,
					"data-item": `tracer:${u}`
				})
			}, (l || f) && c[u].line.setAttribute("d", Fe(a, (e) => i.on(n.paper, d, o.u, e), !0));
			let [p, m] = n.paper.of(...n.paper.project(i.place(d, o.u)));
			e(c[u].dot, {
				cx: r(p),
				cy: r(m)
			});
		});
	};
}
// src/solved.ts
var jn = "input:not([type=range],[type=checkbox]),textarea,[contenteditable]", Mn = "button,summary,select,a,input[type=checkbox],[role=button],[role=tab]", Nn = 6, Pn = 10, Fn = 8, In = 4;
async function Ln(e, t, r, a) {
	let o = await tn.create(t), s = [], c = new Kt(t, o);
	a.changes && c.change(a.changes), a.address && At(o, c, r, location.hash);
	let u = a.pose && o.motion.take(a.pose);
	u != null && (r.t = u), r.t = Math.min(Math.max(Number.isFinite(r.t) ? r.t : t.start, 0), o.end);
	let d = 0, f = !0, p = 0;
	o.cycle();
	let m = new Dt(o, c), h = t.views.charts.flatMap((e) => e.curves.map((n) => ({
		curve: n,
		unit: t.units[e.kind]
	}))), v = h.find((e) => e.curve.of === r.curve) ?? h.find((e) => t.gradient?.curves.includes(e.curve.row)) ?? h[0], y = new En(t, o), b = kn(e, t, o, y, r, {
		play: le,
		show: q,
		go: ie,
		reset: G,
		back: a.back
	}), x = n("main", e), S = n("section", x, {
		class: "stage",
		"aria-label": "mechanism"
	}), C = new _(t.sketch.links, t.sketch.poses, o), w = yt(S, o, t.views.mechanism, t.units, r, {
		full: a.full,
		rates: t.views.rates,
		on: a.on,
		entries: ee,
		chosen: te,
		again: J,
		held: (e) => o.count > 1 && oe(t, `${e.kind}:${e.name}`) >= 0
	}), { m: T, paper: E } = w, D = n("output", E, {
		class: "digits",
		"aria-label": "value of the chosen curve"
	}), O = new wt(T, t, o), k = An(T, C, o, r), A = new Et(E, T, t, o, t.handles.flatMap((e) => e.kind === "joint" || e.kind === "point" ? [e.p] : [])), j = qt(T, t, o, {
		changed: W,
		finished: re
	});
	ce(T, t, o, C, {
		seek: q,
		time: () => r.t
	});
	let M = g(T, t, o), N = n("section", x, {
		class: "side",
		"aria-label": "results"
	}), P = On(N, r, () => J(!0)), F = (e) => (v = h.find((t) => t.curve === e), r.curve = e.of, J(!0)), I = Cn(P, t, o, {
		time: () => r.t,
		seek: q,
		pick: F,
		picked: () => v?.curve
	}, r, () => J(!0)), L = z(), R = nn(P.add("Change", "every number of the file"), t, o, c, (e) => e ? re() : W());
	H(), cn(P.add("About", "method and assumptions"), t);
	function z() {
		let e = n("div", S, { class: "switches" }), { arrows: i, labels: a } = t.views.mechanism;
		Ct(e, w.view, r, o.count > 1, () => J(!0));
		let s = (e) => i.some((t) => e.includes(t.kind)), c = t.views.rates.length > 0, l = [
			["values", !0],
			["digits", h.length > 0],
			["loads", s([
				"load",
				"effort",
				"weight",
				"spring",
				"damper"
			])],
			["reactions", s(["joint", "friction"])],
			["inertia", s(["inertia"])],
			["velocities", c],
			["accelerations", c],
			["names", !0],
			["traces", t.views.mechanism.items.some((e) => e.t === "trace")]
		];
		return t.gradient && xt(e, {
			said: "what lowers the peak",
			title: "arrows: moving a joint in this direction lowers the peak of the chosen curve",
			on: !1,
			act: (e) => (O.on = e, J(!0))
		}), St(e, r, l.flatMap(([e, t]) => t ? [e] : []), a.filter((e) => e.kind === "joint").length > Fn, () => (U(), J(!0))), t.handles.some((e) => e.kind === "joint") && xt(e, {
			said: "tolerances",
			title: "a thousand machines with points displaced by up to 0.5 % of the drawing's width",
			on: !1,
			act: (e) => (A.on = e, J(!0))
		}), T.paper.axes.length > 2 && n("span", e, {}, "drag to rotate the view"), n("span", e, { class: "spread" });
	}
	function B({ kind: e, name: n }) {
		return t.sketch.links[oe(t, `${e}:${n}`)] ?? t.views.mechanism.arrows.find((t) => t.of === n && t.kind === e)?.link;
	}
	function V({ kind: e, name: n }) {
		let r = t.handles.find((t) => t.kind === e && (t.name === n || t.name.startsWith(`${n}:`)));
		return r ? T.paper.point(r.p) : null;
	}
	function ee(e, n) {
		let i = [], a = /* @__PURE__ */ new Set();
		for (let s of e.slice(0, In)) {
			let { kind: e, name: c } = s, u = oe(t, `${e}:${c}`), d = u < 0 ? void 0 : t.sketch.links[u], f = e === "joint" || e === "reaction" ? h.find((e) => e.curve.of === `reaction.${c}.magnitude`) : h.find((t) => t.curve.of.startsWith(`${e}.${c}.`));
			f && i.push({
				said: `Curve of ${l(f.curve.name)}`,
				act: () => (F(f.curve), P.show("Curves"))
			});
			let p = t.numbers.find((t) => t.path.split(".")[1] === c && t.path.startsWith(e === "center" ? "link" : e));
			p && i.push({
				said: `Numbers of ${c}`,
				act: () => (P.show("Change"), R.focus(p.path))
			}), e === "tracer" && i.push({
				said: "Remove this path",
				act: () => (r.tracers.splice(+c, 1), U(), J(!0))
			}), d && !a.has(d) && (a.add(d), i.push({
				said: `Free body of ${d}`,
				act: () => (I.choose(d), P.show("Forces"))
			}), o.count > 1 && i.push({
				said: `Path of this point of ${d}`,
				act: () => {
					r.tracers.push({
						link: d,
						u: C.local(T.paper, u, V(s) ?? T.paper.of(...n))
					}), U(), J(!0);
				}
			}));
		}
		return r.window && i.push({
			said: "Fit the whole mechanism",
			act: w.view.fit
		}), i.filter((e, t) => i.findIndex((t) => t.said === e.said) === t);
	}
	function te(e) {
		e && e.kind !== "joint" && I.choose(B(e)), J(!0);
	}
	function H() {
		let e = P.add("Save", "files to save, print, share"), i = It(t.title), s = (t, r) => n("button", e, { type: "button" }, t).addEventListener("click", r);
		t.template.length && s("Model file", () => X(`${i}.yaml`, jt(t, o), "text/yaml")), s("Curves as CSV", () => X(`${i}.csv`, Mt(t, o), "text/csv")), s("Drawing as SVG", () => X(`${i}.svg`, Nt(T.svg, t.style.light), "image/svg+xml")), s("Drawing as PNG", () => void Ft(T.svg, t.style.light).then((e) => X(`${i}.png`, e, "image/png"))), s("Print", () => window.print()), a.address && s("Copy link", () => {
			location.hash = kt(t, o, r), navigator.clipboard?.writeText(location.href);
		});
	}
	function U() {
		a.address && window.history.replaceState(null, "", "#" + kt(t, o, r)), a.on?.({
			type: "view",
			view: r
		});
	}
	function ne() {
		J(!0), R.update();
		let e = Ot(t, o);
		a.edited?.(e), a.on?.({
			type: "change",
			changes: e
		}), U();
	}
	function W() {
		o.coarse = !0, c.pass(), J(!0);
	}
	function re() {
		o.coarse = !1;
		let { sentence: e } = c;
		c.pass() && (c.sentence = e), m.note(), K(!0), ne();
	}
	function G() {
		c.change({}), re(), K();
	}
	function ie(e) {
		m.go(e) && (K(!0), ne());
	}
	function K(e = !1) {
		o.cycle(), T.fit(void 0, e), I.fit();
	}
	function ae() {
		w.resize();
		let e = N.querySelector(".panels").clientWidth;
		e > 0 && I.resize(e - 12), T.fit(), J(!0);
	}
	function q(e) {
		r.t = Math.min(Math.max(e, 0), o.end), t.only_at_positions && (r.t = Math.round(r.t)), J(!1);
	}
	function se(e) {
		let t = e > 0 ? Math.floor(r.t + 1e-9) + e : Math.ceil(r.t - 1e-9) + e;
		q(o.cyclic ? (t % o.count + o.count) % o.count : t);
	}
	function le() {
		if (b.playing(!p), p) return ue();
		let e = performance.now(), t = r.t, n = (i) => {
			t += (i - e) / 1e3 / Nn * r.speed * o.end, e = i, t >= o.end && (t = 0), q(t), p = requestAnimationFrame(n);
		};
		p = requestAnimationFrame(n);
	}
	function ue() {
		cancelAnimationFrame(p), p = 0;
	}
	function J(e) {
		f ||= e, d ||= requestAnimationFrame(() => {
			d = 0;
			let e = performance.now();
			de(), s.push(performance.now() - e), s.length > 2e3 && s.shift();
		});
	}
	function de() {
		let t = f;
		f = !1, t && o.cycle(), o.at(r.t);
		let n = y.refusal();
		n !== o.refused && (o.refused = n, o.cycle()), e.classList.toggle("unsolved", !o.solved), e.classList.toggle("turning", r.drag === "turn"), T.update(t), k(t), j(), M(), O.update(v?.curve);
		let a = A.update(v?.curve.row), s = O.on && v && O.peak(v.curve), u = s && v ? `arrows lower the peak of ${l(v.curve.name)}, now ${i(s.size / v.unit.size)} ${v.unit.unit}${s.where}` : "";
		L.textContent = [u, a && v ? `${l(v.curve.name)}: ${i(a.mean / v.unit.size)} ± ${i(a.sigma / v.unit.size, 2)} ${v.unit.unit} (1 σ)` : ""].filter(Boolean).join("; "), D.hidden = !v || !T.on("digits"), v && !D.hidden && (D.textContent = `${l(v.curve.name)} ${o.solved ? i(o.here[v.curve.row] / v.unit.size) : "–"} ${v.unit.unit}`), I.update(t), b.update(r.t, m.can, c.sentence);
	}
	e.querySelectorAll("details").forEach((e) => e.addEventListener("toggle", () => J(!0)));
	let Y = a.full ? document : e, fe = (e) => pe(e);
	Y.addEventListener("keydown", fe);
	function pe(e) {
		let t = e.target;
		if (!(e.defaultPrevented || t.closest?.(jn))) {
			if ((e.ctrlKey || e.metaKey) && !e.altKey && /^[zy]$/i.test(e.key)) e.preventDefault(), ie(e.key.toLowerCase() === "z" && !e.shiftKey);
			else if (e.ctrlKey || e.metaKey || e.altKey || o.count < 2) return;
			else e.key === " " && !t.closest?.(Mn) ? (e.preventDefault(), le()) : ".,><:;".includes(e.key) && se((".>:".includes(e.key) ? 1 : -1) * (".,".includes(e.key) ? 1 : Pn));
		}
	}
	return o.at(r.t), K(), {
		kernel: o,
		data: t,
		times: s,
		show: q,
		stage: w,
		opened() {
			ae(), de(), R.update(), w.choose(r.chosen);
		},
		set(e) {
			c.change(e), m.note(), K(!0), J(!0), R.update();
		},
		text: () => jt(t, o),
		pose: () => o.motion.placed(),
		redraw: () => J(!0),
		observed: [E, N],
		resize: ae,
		remove() {
			ue(), Y.removeEventListener("keydown", fe);
		}
	};
}
// src/page.ts
async function Rn(e, t, r = {}) {
	let i = r.view ?? Ge(), a = new ResizeObserver(() => s.resize()), o = [], s = await c(t, r);
	async function c(t, s) {
		let c = document.createElement("div");
		c.className = r.full ? "dalembert full" : "dalembert", c.tabIndex = -1;
		let f = `@media (prefers-color-scheme:dark){${t.style.dark}}@media print{${t.style.light}}`;
		n("style", c).textContent = ".dalembert{--ink:#1d2733;--grey:#5b6672;--paper:#fff;--soft:#f4f6f8;--rim:#d5dbe1;--warn:#b3261e;--accent:#1c56a8;color:var(--ink);background:var(--paper);outline:none;font:15px/1.45 system-ui,DejaVu Sans,sans-serif;container-type:inline-size}.dalembert.full{height:100vh;flex-direction:column;height:100dvh;display:flex;overflow:hidden}.dalembert *{box-sizing:border-box}.dalembert [hidden]{display:none!important}.dalembert header{z-index:2;background:var(--paper);border-bottom:1px solid var(--rim);padding:.3em .8em;position:sticky;top:0}.dalembert h1{text-overflow:ellipsis;white-space:nowrap;margin:0;font-size:1.1em;overflow:hidden}.dalembert .bar{align-items:center;gap:.5em;margin-top:.15em;display:flex}.dalembert .bar input{min-width:4em;accent-color:var(--accent);flex:1}.dalembert .readout{white-space:nowrap;font-variant-numeric:tabular-nums;min-width:8em}.dalembert button{font:inherit;color:inherit;background:var(--soft);border:1px solid var(--rim);cursor:pointer;border-radius:.4em;padding:.15em .6em}.dalembert button:disabled{opacity:.4;cursor:default}.dalembert .mark{color:var(--warn);background:var(--paper);margin:0;padding:.2em .9em;font-size:.92em;position:absolute;top:calc(100% + 1px);left:0;right:calc(clamp(22rem,36cqw,42rem) + 1.6em)}.dalembert .mark:empty{display:none}.dalembert main{grid-template-columns:minmax(0,1fr) clamp(22rem,36cqw,42rem);align-items:start;gap:.8em;padding:.6em .8em;display:grid}.dalembert.full main{flex:1;align-items:stretch;min-height:0;padding-bottom:0}.dalembert .stage{-webkit-user-select:none;user-select:none;flex-direction:column;min-width:0;display:flex;position:sticky;top:5em}.dalembert.full .stage{min-height:0;position:static}.dalembert .paper{aspect-ratio:10/7;min-height:14em;max-height:calc(100vh - 9em);position:relative}.dalembert.full .paper{aspect-ratio:auto;flex:1;min-height:0;max-height:none}.dalembert .side{min-width:0}.dalembert.full .side{flex-direction:column;min-height:0;display:flex}.dalembert .tabs{border-bottom:1px solid var(--rim);flex-wrap:wrap;gap:.15em;display:flex}.dalembert .tabs button{background:0 0;border:0;border-bottom:2px solid #0000;border-radius:0;padding:.2em .55em}.dalembert .tabs button[aria-selected=true]{border-color:var(--accent);font-weight:600}.dalembert .panels{outline:none;padding:.4em .4em 1em 0}.dalembert.full .panels{flex:1;min-height:0;overflow-y:auto}.dalembert h2{margin:.6em 0 .2em;font-size:.95em}.dalembert .group{display:inline-flex}.dalembert .group button{border-radius:0;min-width:2em;font-size:1em}.dalembert .group button+button{border-left:0}.dalembert .group button:first-child{border-radius:.4em 0 0 .4em}.dalembert .group button:last-child{border-radius:0 .4em .4em 0}.dalembert button[aria-pressed=true]{background:var(--accent);color:var(--paper);border-color:var(--accent)}.dalembert .digits{pointer-events:none;font-variant-numeric:tabular-nums;text-shadow:0 0 .2em var(--paper),0 0 .2em var(--paper);font-size:clamp(1.8rem,5cqw,4rem);font-weight:700;position:absolute;top:.1em;left:.25em}.dalembert main.one{flex-direction:column;display:flex}.dalembert main.one .stage{flex:1}.dalembert.full main.one .paper{aspect-ratio:auto;min-height:20em;max-height:none}.dalembert .missing{flex-wrap:wrap;gap:.3em;padding:.1em 0 .4em;display:flex}.dalembert .missing p{color:var(--warn);flex-basis:100%;margin:0;font-size:.92em}.dalembert .menu{z-index:9;background:var(--paper);border:1px solid var(--rim);border-radius:.4em;flex-direction:column;min-width:11em;max-width:min(22em,100vw - 8px);max-height:calc(100vh - 8px);padding:.25em;display:flex;position:fixed;overflow-y:auto;box-shadow:0 .3em 1.2em #00000040}.dalembert .menu button{text-align:left;background:0 0;border:0;border-radius:.3em;padding:.35em .6em}.dalembert .menu button:hover,.dalembert .menu button:focus{background:var(--soft);outline:none}.dalembert .chosen{filter:drop-shadow(0 0 .5px var(--accent)) drop-shadow(0 0 1px var(--accent))}.dalembert.turning .handles{display:none}.dalembert .tracer{fill:currentColor;color:var(--accent);cursor:pointer}.dalembert .paper svg:focus-visible{outline:2px solid var(--accent);outline-offset:-2px}.dalembert svg{touch-action:pan-y;-webkit-user-select:none;user-select:none;width:100%;height:auto;font-family:DejaVu Sans,Helvetica Neue,Arial,sans-serif;display:block;overflow:hidden}.dalembert .paper svg{touch-action:none;outline:none;height:100%;position:absolute;inset:0}.dalembert .cloud{pointer-events:none;width:100%;height:100%;position:absolute;top:0;left:0}.dalembert .switches{color:var(--grey);flex-wrap:wrap;align-items:center;gap:.2em .8em;padding:.3em 0;font-size:.88em;display:flex}.dalembert .switches label{cursor:pointer;align-items:center;gap:.3em;display:flex}.dalembert figure{margin:0 0 .4em}.dalembert figcaption{color:var(--grey);font-size:.85em}.dalembert .panel{border-top:1px solid var(--rim);padding:.3em 0}.dalembert summary{cursor:pointer;padding:.15em 0;font-weight:600}.dalembert select{font:inherit;color:inherit;background:var(--soft);border:1px solid var(--rim);border-radius:.4em;max-width:100%}.dalembert .equation{font-variant-numeric:tabular-nums;overflow-wrap:anywhere;margin:.15em 0;font-size:.85em}.dalembert .answers{border-collapse:collapse;font-variant-numeric:tabular-nums;width:100%;font-size:.85em}.dalembert .answers th{text-align:left;padding:.1em .6em .1em 0;font-weight:400}.dalembert .answers td{text-align:right}.dalembert .answers tr+tr>*{border-top:1px solid var(--soft)}.dalembert .polar{width:49%;padding-right:.6em;display:inline-block}.dalembert fieldset{border:0;border-top:1px solid var(--soft);margin:0;padding:.2em 0;font-size:.88em}.dalembert legend{padding:0 .4em 0 0;font-weight:600}.dalembert fieldset label{grid-template-columns:minmax(0,1fr) 7.5em 4.5em;align-items:center;gap:.4em;margin:.1em 0;display:grid}.dalembert fieldset label input[type=range]{accent-color:var(--accent);grid-column:1/-1}.dalembert fieldset input[type=text]{font:inherit;color:inherit;background:var(--soft);border:1px solid var(--rim);border-radius:.3em;width:100%;padding:.05em .3em}.dalembert input.changed{border-color:var(--accent);font-weight:600}.dalembert .unit{color:var(--grey)}.dalembert .wrong{color:var(--warn);grid-column:1/-1}.dalembert .wrong:empty{display:none}.dalembert input[aria-invalid]{border-color:var(--warn)!important}.dalembert dl{grid-template-columns:auto 1fr;gap:.1em .8em;font-size:.9em;display:grid}.dalembert dd{margin:0}.dalembert .handle{fill:var(--accent);fill-opacity:.1;stroke:var(--accent);stroke-opacity:.35;stroke-width:.25px;cursor:grab;outline:none}.dalembert .handle:hover,.dalembert .handle:focus-visible{fill-opacity:.3;stroke-opacity:1;outline:none}.dalembert .handle.center{fill:#1a7f4b;stroke:#1a7f4b}.dalembert .handle.load{fill:#c1272d;stroke:#c1272d}.dalembert .handle.direction{fill:#7a2fa0;stroke:#7a2fa0}.dalembert .span *{vector-effect:non-scaling-stroke}.dalembert .cursor{stroke:var(--grey);stroke-width:.3px;fill:none}.dalembert .key{cursor:pointer}.dalembert .key.picked{text-decoration:underline}.dalembert .chart svg{cursor:crosshair}.dalembert [data-item]{cursor:pointer}.dalembert select.speed{padding:.1em}.dalembert.unsolved svg:not(.chart svg)>g:not(.gaps){opacity:.3}@container (width<=500px){.dalembert .bar{flex-wrap:wrap;gap:.3em}.dalembert .bar input{flex-basis:100%;order:-1}.dalembert .tabs button{padding:.2em .35em;font-size:.93em}.dalembert .readout{min-width:0;margin-right:auto}.dalembert button{padding:.15em .45em}}@container (width<=760px){.dalembert main{padding:.4em .6em;display:block}.dalembert .stage,.dalembert.full .stage{position:static}.dalembert .paper,.dalembert.full .paper{aspect-ratio:1;width:100%;max-height:56vh}.dalembert .polar{width:100%}.dalembert .mark{right:0}.dalembert.full main{overflow-y:auto}.dalembert.full .side{display:block}.dalembert.full .panels{overflow:visible}.dalembert .tabs{background:var(--paper);z-index:1;position:sticky;top:0}}@media (prefers-color-scheme:dark){.dalembert{--ink:#e8edf2;--grey:#9aa7b4;--paper:#151b22;--soft:#222b35;--rim:#323d48;--warn:#ff7b74;--accent:#6fa8f5}}@media print{.dalembert{--ink:#000;--grey:#444;--paper:#fff;--soft:#fff;--rim:#999;--accent:#000}.dalembert header,.dalembert .stage{position:static}.dalembert.full{height:auto;display:block;overflow:visible}.dalembert .paper,.dalembert.full .paper{aspect-ratio:10/7;max-height:none}.dalembert.full .side,.dalembert.full .panels{display:block;overflow:visible}.dalembert .mark{position:static}.dalembert .bar,.dalembert .switches,.dalembert .handles,.dalembert .tabs,.dalembert .menu,.dalembert [data-tab=Save],.dalembert select{display:none}.dalembert main{display:block}.dalembert figure,.dalembert .panel{break-inside:avoid}}" + t.style.light + f;
		let p = o.length ? () => void u() : void 0, m = t.format === "dalembert-sketch/1" ? await Vt(c, t, i, {
			...s,
			taken: l,
			back: p
		}) : t.format === "dalembert-page/1" ? await Ln(c, t, i, {
			...s,
			back: p
		}) : null;
		if (!m) throw Error(`this page cannot show data of format ${t.format}`);
		let h = d();
		a.disconnect(), e.replaceChildren(c), m.opened();
		for (let e of m.observed) a.observe(e);
		return h && c.querySelector(h)?.focus({ preventScroll: !0 }), m;
	}
	async function l(e, t) {
		o.push(s.data), await p(e, t);
	}
	async function u() {
		let e = o.pop();
		e && await p(e);
	}
	function d() {
		let t = e.contains(document.activeElement) ? document.activeElement : null;
		if (!t) return "";
		let n = [
			"data-path",
			"data-item",
			"aria-label"
		].find((e) => t.hasAttribute(e));
		return n ? `${t.tagName.toLowerCase()}[${n}="${CSS.escape(t.getAttribute(n))}"]` : "";
	}
	async function f(e, t) {
		o.length = 0, await p(e, t);
	}
	async function p(e, t = s.pose()) {
		let n = s;
		s = await c(e, {
			...r,
			changes: void 0,
			address: !1,
			pose: t ?? void 0
		}), n.remove(), r.on?.({ type: "put" });
	}
	return {
		get kernel() {
			return s.kernel;
		},
		get data() {
			return s.data;
		},
		get times() {
			return s.times;
		},
		get svg() {
			return s.stage.m.svg;
		},
		get overlay() {
			return s.stage.overlay;
		},
		get sketch() {
			return s.sketch;
		},
		view: i,
		replace: f,
		set: (e) => s.set(e),
		show: (e) => s.show(e),
		text: () => s.text(),
		pose: () => s.pose(),
		redraw: () => s.redraw(),
		hit: (e, t) => s.stage.hit(e, t),
		metres: (e, t) => s.stage.metres(e, t),
		choose: (e) => s.stage.choose(e),
		paper: (e) => s.stage.m.paper.of(...s.stage.m.paper.project(e)),
		remove() {
			a.disconnect(), s.remove(), e.replaceChildren();
		}
	};
}
// src/main.ts
async function zn(e, t) {
	try {
		return await Rn(e, JSON.parse(new TextDecoder().decode(await ne(t))), {
			address: location.protocol !== "about:",
			full: !0
		});
	} catch (t) {
		throw e.textContent = String(t), t;
	}
}
var Bn = { async render({ model: e, el: t }) {
	let r = "", i = Ge(), a = (t) => {
		r = JSON.stringify(t), e.set("changes", t), e.save_changes();
	}, o = (t) => {
		(t.type === "put" || t.type === "pose" || t.type === "change" && e.get("text")) && (e.set("text", c.text()), e.save_changes());
	}, s = async () => {
		let r = await Rn(t, e.get("data"), {
			edited: a,
			on: o,
			changes: e.get("changes"),
			view: i
		});
		return n("style", t, {}, `[data-dalembert="${e.get("frame")}"]{display:none}`), r;
	}, c = await s(), l = async () => {
		i.window = null, c.remove(), c = await s();
	}, u = () => JSON.stringify(e.get("changes")) !== r && c.set(e.get("changes"));
	return e.on("change:data", l), e.on("change:changes", u), () => {
		e.off("change:data", l), e.off("change:changes", u), c.remove();
	};
} };
export { Bn as default, Rn as mount, zn as open };
