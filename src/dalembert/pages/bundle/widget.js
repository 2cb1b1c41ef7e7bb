function e(e, t, n) {
	e.getAttribute(t) !== n && e.setAttribute(t, n);
}
function t(e, t) {
	e.textContent !== t && (e.textContent = t);
}
function n(t, n) {
	for (let r in n) e(t, r, String(n[r]));
	return t;
}
function r(e, t, r = {}) {
	let i = n(document.createElementNS("http://www.w3.org/2000/svg", e), r);
	return t?.append(i), i;
}
function i(e, t, r = {}, i = "") {
	let a = n(document.createElement(e), r);
	return i && (a.textContent = i), t?.append(a), a;
}
function a(e) {
	let t = Math.round(100 * Math.min(Math.abs(e), 1e6)), n = Math.floor(t / 100), r = t % 100;
	return (e < 0 && t ? "-" : "") + n + (r ? (r < 10 ? ".0" : ".") + r : "");
}
var o = (e, t = 4) => Number.isFinite(e) ? String(+e.toPrecision(t)).replace("-", "−") : "–";
function s(e, t = !1) {
	return e.length ? "M" + e.map(([e, t]) => a(e) + " " + a(t)).join("L") + (t ? "Z" : "") : "";
}
function c(t, n, r) {
	e(t, "transform", `translate(${a(n)} ${a(r)})`);
}
function l(e, t) {
	let n = new DOMPoint(t.clientX, t.clientY).matrixTransform(e.getScreenCTM().inverse());
	return [n.x, n.y];
}
function u(e, t, n) {
	e.replaceChildren();
	let i = !1;
	for (let a of t.split(/(_\{[^}]*\})/)) {
		if (!a) continue;
		let t = a.startsWith("_{"), o = r("tspan", e, t ? { "font-size": .7 * n } : {});
		o.textContent = t ? a.slice(2, -1) : a, t !== i && o.setAttribute("dy", String((t ? .25 : -.25) * n)), i = t;
	}
}
var d = (e) => e.replace(/_\{([^}]*)\}/g, "$1"), f = null, p = /* @__PURE__ */ new Map();
function m(e, t, n = !1) {
	let r = `${n}${e}`, i = p.get(r);
	if (i === void 0) {
		f ??= document.createElement("canvas").getContext("2d"), f.font = `${n ? "bold " : ""}100px "DejaVu Sans", "Helvetica Neue", Arial, sans-serif`, i = 0;
		for (let t of e.split(/(_\{[^}]*\})/)) {
			let e = t.startsWith("_{");
			i += f.measureText(e ? t.slice(2, -1) : t).width / 100 * (e ? .7 : 1);
		}
		p.set(r, i);
	}
	return i * t;
}
function h(e, t, n, i, a = "middle") {
	let o = r("text", e, {
		class: `l-${t}-t`,
		"font-size": i,
		"text-anchor": a
	});
	return u(o, n, i), o;
}
var g = class {
	g;
	shaft;
	head;
	constructor(e, t, n = "") {
		this.g = r("g", e), n && (r("title", this.g).textContent = d(n)), this.shaft = r("path", this.g, {
			class: `l-${t}`,
			style: "fill:none"
		}), this.head = r("path", this.g, { class: `l-${t}-h` });
	}
	set(t, n, r = .3) {
		let i = n[0] - t[0], a = n[1] - t[1], o = Math.hypot(i, a), c = o > r && Number.isFinite(o);
		if (e(this.g, "display", c ? "inline" : "none"), !c) return !1;
		let l = i / o, u = a / o, d = Math.min(3, .75 * o), f = .3 * d, p = [n[0] - d * l, n[1] - d * u];
		return e(this.shaft, "d", s([t, [n[0] - .8 * d * l, n[1] - .8 * d * u]])), e(this.head, "d", s([
			n,
			[p[0] - f * u, p[1] + f * l],
			[p[0] + f * u, p[1] - f * l]
		], !0)), !0;
	}
};
function _(e) {
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
function v(e, t, i) {
	let c = r("g", e.svg, {
		class: "gaps",
		"pointer-events": "none"
	}), { unit: l, size: u } = t.units.length, d = "";
	return () => {
		let t = i.open.map((t) => {
			let [n, r] = [t.p, t.q].map((t) => e.paper.of(...e.paper.project(t)));
			return {
				p: n,
				q: r,
				said: `${t.joint} is open by ${o(Math.hypot(...t.p.map((e, n) => e - t.q[n])) / u, 3)} ${l}`
			};
		}), f = JSON.stringify(t);
		if (f !== d) {
			d = f, c.replaceChildren();
			for (let { p: e, q: i, said: o } of t) {
				r("path", c, {
					class: "l-gap",
					d: s([e, i]),
					style: "fill:none"
				});
				let [t, l] = [i[0] - e[0], i[1] - e[1]], u = Math.hypot(t, l) || 1, d = l < 0 ? -1 : 1;
				n(h(c, "gap", o, 3.3, "start"), {
					x: a((e[0] + i[0]) / 2 + d * 4 * l / u + 2),
					y: a((e[1] + i[1]) / 2 - d * 4 * t / u + 1)
				});
			}
		}
	};
}
// src/material.ts
var y = class {
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
}, b = 1e-9, x = 1e-12, S = .25, C = 1e-13, w = 1e-9, T = 1e5, E = 1e3, D = .05, O = 1e-5, k = (e) => ({
	point: e.point.slice(),
	rotation: e.rotation.slice(),
	turn: e.turn.slice()
}), A = class {
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
		let { n, data: r, right: i } = this, a = r.dimension, o = k(e);
		return r.links.forEach((e, s) => {
			let c = n * this.place[s];
			for (let e = 0; e < a; e++) o.point[a * s + e] += t * r.length * i[c + e];
			a === 2 ? (o.turn[s] += t * i[c + 2], o.rotation[2 * s] = Math.cos(o.turn[s]), o.rotation[2 * s + 1] = Math.sin(o.turn[s])) : N(o.rotation, 9 * s, t * i[c + 3], t * i[c + 4], t * i[c + 5]);
		}), r.turns.length && (this.evaluate(o), r.turns.forEach((e, t) => o.turn[t] = this.program.at(e))), o;
	}
	correct(e, t = Infinity, n = 12, r = w) {
		let i = this.gap(e), a = 0, o = 0;
		for (let s = 0; s < n; s++) {
			if (i <= x) return {
				pose: e,
				first: a,
				rest: o
			};
			if (!Number.isFinite(i)) return null;
			let n = this.solve(r);
			if (s ? o += n : a = n, !(a + o <= t)) return null;
			let c = this.moved(e, Math.min(1, S / n)), l = this.gap(c);
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
			let t = this.correct(r, .5, 12, C), n = this.apart(r, e.pose);
			if (t && t.first + t.rest <= .1 * n + 1e-7) return t.pose;
		}
		let i = this.correct(e.pose, .6, 10, e.stations > 1 ? C : w);
		return i && i.first <= .5 && i.rest <= .15 * i.first + 1e-9 && !(r && i.first > 3 * this.apart(r, e.pose) + 1e-6) ? i.pose : null;
	}
	loosen(e, t, n) {
		return this.least(e, t, (e) => e.joint === n && e.kind === "constraint" ? 1 : T, 60);
	}
	open(e, t) {
		let { n, right: r, data: i } = this, a = i.dimension, o = /* @__PURE__ */ new Map();
		r.fill(0), i.links.forEach((e, t) => {
			for (let e = a; e < n; e++) r[n * this.place[t] + e] = D * Math.cos(t * (n - a) + e - a);
		});
		let s = this.least(this.moved(e, 1), t, (e) => e.kind === "freedom" ? E * E : 1, 300, Infinity, 1);
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
		})), o = a.filter(({ r: e }) => e.kind !== "freedom"), s = a.filter(({ k: e }) => t.drives.includes(e)), c = j([...o, ...s].map(({ j: e }) => [...e]), n), l = (e) => c.some((t) => Math.abs(t.reduce((t, n, r) => t + n * e[r], 0)) > 1e-6);
		return {
			freedoms: j(o.map(({ j: e }) => [...e]), n).length,
			links: t.links.filter((e, t) => c.some((e) => e.slice(r * this.place[t], r * this.place[t] + r).some((e) => Math.abs(e) > 1e-6))),
			joints: a.flatMap(({ r: e, j: t }) => e.kind === "freedom" && l(t) ? [e] : [])
		};
	}
	least(e, t, n, r, i = S, a = .001) {
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
function j(e, t) {
	let n = Array.from({ length: t }, (e, t) => t), r = [], i = Math.max(0, ...e.flat().map(Math.abs));
	for (let a = 0; a < Math.min(e.length, t); a++) {
		let o = 0, s = a, c = a;
		for (let r = a; r < e.length; r++) for (let i = a; i < t; i++) Math.abs(e[r][n[i]]) > o && ([o, s, c] = [
			Math.abs(e[r][n[i]]),
			r,
			i
		]);
		if (!(o > O * i)) break;
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
var M = class {
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
function N(e, t, n, r, i) {
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
// src/poses.ts
var P = (e) => e - 2 * Math.PI * Math.round(e / (2 * Math.PI)), F = class {
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
function I(e, t, n) {
	let r = k(t);
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
		], 3 * i), r.rotation.set(R([
			c / f,
			l / f,
			u / f
		], d), 9 * i);
	}), r;
}
function L(e, t, n) {
	let r = k(t);
	return e.links.forEach((t, i) => {
		let a = n[t], o = e.dimension;
		if (a?.length === (o === 2 ? 3 : 12) && a.every(Number.isFinite)) {
			if (r.point.set(a.slice(0, o), o * i), o === 3) return r.rotation.set(a.slice(3), 9 * i);
			r.turn[i] = a[2], r.rotation.set([Math.cos(a[2]), Math.sin(a[2])], 2 * i);
		}
	}), r;
}
function R([e, t, n], r) {
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
function z(e) {
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
function B(e) {
	return Uint8Array.from(atob(e), (e) => e.charCodeAt(0));
}
function V(e) {
	if (typeof e == "string") return new Float64Array(B(e).buffer);
	let t = (e.to - e.from) / Math.max(e.count - 1, 1);
	return Float64Array.from({ length: e.count }, (n, r) => r === e.count - 1 ? e.to : e.from + r * t);
}
async function H(e) {
	let t = new Blob([B(e)]).stream().pipeThrough(new DecompressionStream("deflate"));
	return new Response(t).arrayBuffer();
}
var U = class e {
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
		let { instance: r } = await WebAssembly.instantiate(await H(t.wasm)), { memory: i, run: a } = r.exports;
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
}, W = {
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
}, ee = (e, t) => !!e && !!t && e.kind === t.kind && e.name === t.name;
function te(e, t, n, r = 6) {
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
				t && !a.has(t) && a.set(t, 2 * s + (W[G(t).kind] ?? 2));
			}
		}
	}), [...a].sort((e, t) => e[1] - t[1]).map(([e]) => G(e));
}
function ne(e, t) {
	e.querySelectorAll(".chosen").forEach((e) => e.classList.remove("chosen")), t && e.querySelectorAll(`[data-item="${CSS.escape(`${t.kind}:${t.name}`)}"]`).forEach((e) => e.classList.add("chosen"));
}
// src/pull.ts
var re = 1 / 10;
function ie(e, t) {
	if (!t) return -1;
	let { kind: n, name: r } = G(t), { links: i, rows: a } = e.sketch;
	return n === "link" || n === "center" ? i.indexOf(r) : (n === "joint" ? a.find((e) => e.joint === r)?.ends : void 0)?.find((e) => e < i.length) ?? -1;
}
function ae(e, t, n) {
	for (let { kind: r, name: i } of te(e, t.clientX, t.clientY, t.pointerType === "touch" ? 14 : 6)) {
		let e = n(`${r}:${i}`);
		if (e >= 0) return e;
	}
	return -1;
}
function oe(e, t, n, r, i) {
	if (n.count < 2) return;
	let a = -1, o = [];
	e.svg.addEventListener("pointerdown", (n) => {
		a = n.button === 0 ? ae(e.svg, n, (e) => ie(t, e)) : -1, a < 0 || (e.svg.setPointerCapture(n.pointerId), o = r.local(e.paper, a, l(e.svg, n)));
	}), e.svg.addEventListener("pointermove", (t) => {
		a >= 0 && e.svg.hasPointerCapture(t.pointerId) && i.seek(c(l(e.svg, t)));
	});
	let s = () => void (a = -1);
	e.svg.addEventListener("pointerup", s), e.svg.addEventListener("pointercancel", s);
	function c(t) {
		let { count: s, cyclic: c } = n, l = i.time(), u = Math.max(3, Math.ceil(s * re)), d = l, f = Infinity, p = /* @__PURE__ */ new Map(), m = (t) => (p.has(t) || p.set(t, n.motion.poses[t] ? r.on(e.paper, a, o, t) : null), p.get(t));
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
var se = 12, ce = 1e6, le = .001, ue = 1e-5, K = 1e6, de = .5, q = 6, fe = 100, J = .2, pe = class extends A {
	pose;
	closed = !1;
	away = 0;
	damping = le;
	constructor(e, t, n) {
		super(e, t), this.pose = n, this.placed(n);
	}
	placed(e) {
		this.data.rows.forEach((t, n) => t.kind === "phase" && (this.hold[n] = this.measure(n, e))), this.pose = e, this.damping = le, this.closed = this.gap(e) <= b;
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
		for (let r = 0; r < se; r++) {
			if (this.away < n) return this.ended("there");
			let r = this.step(e, t, n);
			if (!r) return this.ended("nearest");
			let i = this.away - this.far(e, t, r);
			if (this.pose = r, this.away -= i, i < n / 20) return this.ended(this.away < n ? "there" : "nearest");
		}
		return "on the way";
	}
	ended(e) {
		return this.damping = le, e;
	}
	step(e, t, n) {
		let { pose: r, data: i } = this, a = Math.min(1, de / this.away), o = this.at(e).map((e, n) => a * (t[n] - e) / i.length);
		for (let i = 0; i < q; i++) {
			this.gap(r), this.weight.fill(ce), this.fill(this.damping), this.weight.fill(1), this.pull(e, r, o);
			let i = this.answer();
			if (!(i >= n / 10)) return null;
			let a = this.correct(this.moved(r, Math.min(1, S / i)), .5 * Math.min(i, S) + 1e-9, 8)?.pose;
			if (a && this.far(e, t, a) < this.away) return this.damping = Math.max(this.damping / 4, ue), a;
			this.damping = Math.min(this.damping * 8, K);
		}
		return null;
	}
	gather(e, t) {
		let n = (n) => {
			let r = this.gap(n), i = this.missing.reduce((e, t, n) => e + (this.active[n] ? fe * t * t : 0), 0);
			return Number.isFinite(r) ? i + (e ? this.far(e, t, n) ** 2 : 0) : Infinity;
		}, r = Math.max(this.damping, .01), i = n(this.pose);
		for (let a = 0; a < se && r < 1e8; a++) {
			this.gap(this.pose), this.weight.fill(fe), this.fill(r), this.weight.fill(1), e && this.pull(e, this.pose, this.at(e).map((e, n) => (t[n] - e) / this.data.length));
			let a = this.answer(), o = this.moved(this.pose, Math.min(1, S / a)), s = n(o);
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
		let a = this.correct(k(this.pose), J)?.pose;
		return a ? (this.placed(a), "on the way") : "apart";
	}
}, Y = [
	[1, -1],
	[-1, -1],
	[1, 1],
	[-1, 1],
	[0, -1],
	[1, 0],
	[-1, 0],
	[0, 1]
], me = [
	1,
	1.9,
	3,
	4.5
];
function he(e, t, n, r) {
	return {
		el: h(e, t, n, r),
		text: n,
		size: r,
		bold: t === "title",
		choice: -1
	};
}
function ge(e, t) {
	e.text !== t && (e.text = t, u(e.el, t, e.size));
}
var _e = class {
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
		let t = e.label, n = m(t.text, t.size, t.bold) + .5, r = 1.1 * t.size + (t.text.includes("_") ? .3 * t.size : 0), i = e.leave ?? 1.2, a = e.away && Math.hypot(...e.away) || 1, o = Infinity, s = 0, l = [
			0,
			0,
			0,
			0
		], u = Y.length * me.length, d = (c) => {
			let [d, f] = e.anchors[Math.floor(c / u)], [p, m] = Y[c % Y.length], h = c % u * .12 + .2 * Math.floor(c / u) - (c === t.choice ? .4 : 0);
			if (e.away && (h += 1.2 * (1 - (p * e.away[0] + m * e.away[1]) / (Math.hypot(p, m) * a))), h >= o) return;
			let g = i * me[Math.floor(c % u / Y.length)], _ = d + p * (g + n / 2), v = f + m * (g + r / 2), y = [
				_ - n / 2,
				v - r / 2,
				_ + n / 2,
				v + r / 2
			];
			(h += this.cost(y, o - h)) < o && (o = h, s = c, l = y);
		}, f = e.anchors.length * u;
		t.choice >= 0 && t.choice < f && d(t.choice);
		for (let e = 0; e < f; e++) e !== t.choice && d(e);
		t.choice = s, this.texts.push(l), c(t.el, (l[0] + l[2]) / 2, l[1] + .91 * t.size);
	}
	cost(e, t) {
		let [n, r, i, a] = this.bounds, o = e[0] < n || e[1] < r || e[2] > i || e[3] > a ? 60 : 0;
		for (let t of this.texts) {
			let n = ve(e, t);
			n > 0 && (o += 60 + 5 * n);
		}
		for (let t of this.discs) {
			let n = ve(e, t);
			n > 0 && (o += 8 + n);
		}
		for (let [n, r] of this.lines) {
			if (o >= t) return o;
			ye(e, n, r) && (o += 6);
		}
		return o;
	}
};
function ve(e, t) {
	let n = Math.min(e[2], t[2]) - Math.max(e[0], t[0]), r = Math.min(e[3], t[3]) - Math.max(e[1], t[1]);
	return n > 0 && r > 0 ? n * r : 0;
}
function ye(e, t, n) {
	if (Math.max(t[0], n[0]) < e[0] || Math.min(t[0], n[0]) > e[2] || Math.max(t[1], n[1]) < e[1] || Math.min(t[1], n[1]) > e[3]) return !1;
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
var be = (e, t, n) => t.reduce((t, r, i) => t + e[i] * n(r), 0), xe = class {
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
		return e.length < 3 ? [t(e[0]), t(e[1])] : [be(this.axes[0], e, t), be(this.axes[1], e, t)];
	}
	depth(e) {
		return be(this.axes[2], e, (e) => this.kernel.here[e]);
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
function Se(e, t, n) {
	let r = Ce(e, t, n);
	return t.of && (e.lastElementChild.dataset.item = t.of.join(":")), r;
}
function Ce(t, i, o) {
	let c = o.kernel.here;
	if (i.t === "symbol") {
		let n = r("g", t, i.per_mm ? { class: "span" } : {});
		return n.innerHTML = i.svg, {
			update() {
				let [t, r] = o.point(i.p), s = i.per_mm ? ` scale(${(i.per_mm / o.perMm).toFixed(4)})` : "", l = i.e ? ` rotate(${a(-Math.atan2(c[i.e[1]], c[i.e[0]]) * 180 / Math.PI)})` : "";
				e(n, "transform", `translate(${a(t)} ${a(r)})${l}${s}`);
			},
			mark: (e) => e.disc(o.point(i.p), 1.6)
		};
	}
	if (i.t === "span") {
		let n = r("g", t, { class: "span" });
		return n.innerHTML = i.svg, {
			update() {
				let [[t, r], [s, c]] = i.p.map((e) => o.point(e)), l = Math.hypot(s - t, c - r), u = Math.atan2(c - r, s - t) * 180 / Math.PI;
				e(n, "transform", `translate(${a(t)} ${a(r)}) rotate(${a(u)}) scale(${(l / i.length).toFixed(4)} 1)`);
			},
			mark: (e) => e.line(o.point(i.p[0]), o.point(i.p[1]))
		};
	}
	if (i.t === "circle") {
		let e = r("circle", t, { class: `l-${i.role}` });
		return { update() {
			let [t, r] = o.point(i.p);
			n(e, {
				cx: a(t),
				cy: a(r),
				r: a(Math.abs(c[i.r]) / o.perMm)
			});
		} };
	}
	if (i.t === "pair") return Te(t, i, o);
	let l = r("path", t, {
		class: `l-${i.role}`,
		style: "fill:none"
	});
	if (i.t === "trace") return { update: () => e(l, "d", je(o.kernel, (e) => o.pointAt(i.p[0], e), !0)) };
	if (i.t === "hull" && (l.dataset.link = i.link), i.t === "arc") return { update: () => e(l, "d", we(i.p.map((e) => o.point(e)), i.ccw)) };
	let u = [], d = !1;
	return {
		update() {
			let t = i.p.map((e) => o.point(e)), r = i.t === "hull" ? _(t) : t;
			d = i.t === "hull" && r.length > 2, u = d ? r : t, i.t === "hull" && n(l, {
				class: d ? "l-link-area" : "l-link",
				style: d ? "" : "fill:none"
			}), e(l, "d", s(u, d));
		},
		mark(e) {
			u.forEach((t, n) => (n || d) && e.line(u.at(n - 1), t));
		}
	};
}
function we([e, t, n], r) {
	let i = ([t, n]) => Math.atan2(e[1] - n, t - e[0]), o = (i(n) - i(t)) * (r ? 1 : -1), s = a(Math.hypot(t[0] - e[0], t[1] - e[1])), c = (o + 4 * Math.PI) % (2 * Math.PI) > Math.PI;
	return `M${a(t[0])} ${a(t[1])}A${s} ${s} 0 ${+c} ${+!r} ${a(n[0])} ${a(n[1])}`;
}
function Te(t, n, i) {
	let o = r("g", t), s = n.size ? "link-area" : n.fixed ? "support" : "block", c = r("path", o, { class: `l-${s}` }), l = r("path", o, { class: `l-${n.shape === "ball" || n.size ? s : "pin"}` }), u = n.shape === "block" ? 4.2 : 3.4, d = n.shape === "block" ? 2.2 : 1.7;
	return {
		update() {
			n.size && ([d, u] = n.size.map((e) => +a(e / i.perMm)));
			let [t, r] = i.point(n.p), [s, f] = i.here(n.e), p = i.depth(n.e);
			if (e(o, "transform", `translate(${a(t)} ${a(r)}) rotate(${a(-Math.atan2(f, s) * 180 / Math.PI)})`), n.shape === "ball") return e(c, "d", `M${d} 0A${d} ${d} 0 1 0 ${-d} 0A${d} ${d} 0 1 0 ${d} 0Z`);
			let m = u * Math.hypot(s, f), h = d * Math.abs(p), g = p >= 0 ? m : -m;
			n.shape === "round" ? (e(c, "d", `M${a(-m)} ${-d}L${a(m)} ${-d}A${a(h)} ${d} 0 0 1 ${a(m)} ${d}L${a(-m)} ${d}A${a(h)} ${d} 0 0 1 ${a(-m)} ${-d}Z`), e(l, "d", `M${a(g + h)} 0A${a(h)} ${d} 0 1 0 ${a(g - h)} 0A${a(h)} ${d} 0 1 0 ${a(g + h)} 0Z`)) : (e(c, "d", `M${a(-m - h)} ${-d}H${a(m + h)}V${d}H${a(-m - h)}Z`), e(l, "d", `M${a(g - h)} ${-d}H${a(g + h)}V${d}H${a(g - h)}Z`));
		},
		mark(e) {
			if (n.size) return;
			let [t, r] = i.point(n.p), [a, o] = i.here(n.e), s = n.shape === "ball" ? 0 : u;
			e.disc([t, r], 2.4), e.line([t - s * a, r + s * o], [t + s * a, r - s * o]);
		}
	};
}
var Ee = 240, De = .04, Oe = 12, ke = 3;
function Ae(e, t, n) {
	let r = e[2 * t], i = e[2 * t + 1], a = e[2 * n] - r, o = e[2 * n + 1] - i, s = a * a + o * o;
	for (let c = t + 1; c < n; c++) {
		let t = e[2 * c] - r, n = e[2 * c + 1] - i, l = t * a + n * o;
		if ((t * o - n * a) ** 2 > De * De * s || l < 0 || l > s) return !1;
	}
	return !0;
}
function je(e, t, n = !1) {
	let r = n && e.cyclic ? e.count : e.count - 1, i = e.count > Ee, o = i && e.coarse ? ke : 1, s = Math.ceil(r / o), c = new Float64Array(2 * s + 2), l = "", u = -1, d = (e, t = "L") => {
		l += `${t}${a(c[2 * e])} ${a(c[2 * e + 1])}`, u = e;
	};
	for (let n = 0; n <= s; n++) {
		let a = Math.min(n * o, r) % e.count, s = !!e.good[a];
		s && c.set(t(a), 2 * n), s && u < 0 ? d(n, "M") : u >= 0 && u < n - 1 && !(s && i && n - u <= Oe && Ae(c, u, n)) && d(n - 1), s ? e.reverses(a) && (u < n && d(n), c.set(e.onceAfter(() => t(a)), 2 * n), d(n)) : u = -1;
	}
	return u >= 0 && u < s && d(s), l;
}
function Me(e, t, n, r, i) {
	let { unit: a, size: s } = i.units[r] ?? {
		unit: "",
		size: 1
	};
	ge(e, i.values ? `${t} = ${o(n / s)} ${a}`.trim() : t);
}
function Ne(e, t, n, r, i, a = "force") {
	return t.t === "couple" ? Re(e, t, n) : Ie(e, t, n, r, i, a);
}
var Pe = (e, t) => void (e.dataset.item = `${t.kind === "joint" ? "reaction" : t.kind}:${t.of}`), Fe = 13;
function Ie(t, n, r, i, a, o) {
	let s = new g(t, n.role, n.name), c = n.t === "force" ? null : new g(t, n.role), l = n.t === "force" ? n.f : n.m, u = he(t, n.role, n.name, 3.4), d = [0, 0], f = [0, 0], p = [0, 0], m = !1;
	for (let e of [s, c]) e && Pe(e.g, n);
	return {
		label: u,
		hide() {
			m = s.set([0, 0], [0, 0]), c?.set([0, 0], [0, 0]), e(u.el, "visibility", "hidden");
		},
		update() {
			let t = r.point(n.p), [h, g] = r.here(l), _ = c ? Math.hypot(...l.map((e) => r.kernel.here[e])) / Fe || 1 : i(), v = [h / _, -g / _], y = !1;
			if (a && a.length > 1 && !c) {
				let e = a.map((e) => r.point(e)), n = [0, 1].map((t) => e.reduce((e, n) => e + n[t], 0) / e.length);
				y = v[0] * (n[0] - t[0]) + v[1] * (n[1] - t[1]) > 1e-9;
			}
			[d, f] = y ? [[t[0] - v[0], t[1] - v[1]], t] : [t, [t[0] + v[0], t[1] + v[1]]], p = y ? d : f, m = s.set(d, f), c?.set(d, [d[0] + .78 * (f[0] - d[0]), d[1] + .78 * (f[1] - d[1])]), e(u.el, "visibility", m ? "visible" : "hidden"), m && Me(u, n.name, Math.hypot(...l.map((e) => r.kernel.here[e])), c ? "moment" : o, r);
		},
		mark: (e) => m && e.line(d, f),
		anchor() {
			if (!m) return null;
			let e = p === d ? f : d, t = [p[0] - e[0], p[1] - e[1]];
			return [
				p,
				[p[0] - .35 * t[0], p[1] - .35 * t[1]],
				t
			];
		}
	};
}
var Le = 4.6;
function Re(t, n, i) {
	let o = i.kernel.here, s = r("g", t), c = he(t, n.role, n.name, 3.4);
	r("title", s).textContent = d(n.name), r("path", s, {
		class: `l-${n.role}`,
		style: "fill:none",
		d: "M4.17 1.94A4.6 4.6 0 1 0 -4.17 1.94"
	}), r("path", s, {
		class: `l-${n.role}-h`,
		d: "M-4.17 2.9L-5.6 -0.1L-3 0.3Z"
	});
	let l = !1;
	return Pe(s, n), {
		label: c,
		hide() {
			l = !1, e(s, "display", "none"), e(c.el, "visibility", "hidden");
		},
		update() {
			let [t, r] = i.point(n.p), u = o[n.m[0]];
			l = Number.isFinite(u) && Math.abs(u) > 1e-9, e(s, "display", l ? "inline" : "none"), e(c.el, "visibility", l ? "visible" : "hidden"), e(s, "transform", `translate(${a(t)} ${a(r)}) scale(${u < 0 ? -1 : 1} 1)`), l && Me(c, n.name, Math.abs(u), "moment", i);
		},
		mark(e) {
			l && e.disc(i.point(n.p), Le);
		},
		anchor() {
			let [e, t] = i.point(n.p);
			return l ? [
				[e, t - Le],
				[e - Le, t],
				[e + Le, t],
				[e, t + Le],
				[0, -1]
			] : null;
		}
	};
}
// src/branches.ts
var ze = class {
	data;
	kernel;
	shown;
	values;
	inputs;
	of;
	model;
	driven;
	channels;
	constructor(e, t, n, r, i, a, o) {
		this.data = e, this.kernel = n, this.shown = r, this.values = i, this.inputs = a, this.driven = Array.from({ length: o }, (e, t) => n.drives(t)), this.of = e.branches.map(() => new Float64Array(o).fill(1)), this.model = new Float64Array(e.branches.length).fill(1), this.channels = r.module.channels.map((n) => {
			let [r, o, s] = n.split(" "), c = e.branches.indexOf(n);
			return r === "pose" ? {
				kind: r,
				part: o,
				k: +s,
				given: i
			} : r === "position" ? {
				kind: r,
				part: "turn",
				k: t.indexOf(n.slice(9)),
				given: i
			} : {
				kind: c < 0 ? "given" : "branch",
				part: "turn",
				k: c,
				given: c < 0 ? a(n) : i
			};
		});
	}
	read(e, t) {
		let n = new Float64Array(this.of.length).fill(1);
		for (let r = 0; r < n.length; r++) n[r] = this.look(e, t, n).at(r) < 0 ? -1 : 1;
		return n;
	}
	look(e, t, n) {
		let r = this.shown, i = this.kernel.drives(t);
		return r.values.set(this.values), this.channels.forEach((t, a) => r.put(a, t.kind === "pose" ? e[t.part][t.k] : t.kind === "position" ? i[t.k] : t.kind === "branch" ? n[t.k] : t.given[0])), r.call(1), r;
	}
	spread(e, t, n) {
		let r = this.shown, { row: i } = r, a = t.length;
		this.model = e, r.values.set(this.values);
		let o = t.map((e) => e ?? n), { path: s } = r;
		this.channels.forEach(({ kind: e, part: t, k: n, given: r }, c) => {
			let l = c * i;
			if (e === "pose") for (let e = 0; e < a; e++) {
				let r = o[e];
				s[l + e] = r instanceof F ? r.value(t, n) : r[t][n];
			}
			else if (e === "position") for (let e = 0; e < a; e++) s[l + e] = this.driven[e][n];
			else e === "given" && s.set(r.subarray(0, a), l);
		});
		for (let n = !0, o = this.of.length + 1; n && o; o--) this.channels.forEach((e, t) => e.kind === "branch" && r.path.set(this.of[e.k], t * i)), r.call(a), n = !1, this.of.forEach((i, o) => {
			for (let s = 0; s < a; s++) {
				let a = t[s] ? r.at(o, s) < 0 ? -1 : 1 : e[o];
				n ||= a !== i[s], i[s] = a;
			}
		});
		this.of.forEach((e, t) => this.inputs(this.data.branches[t]).set(e)), this.data.known.forEach((e, n) => {
			let i = this.inputs(e);
			for (let e = 0; e < a; e++) i[e] = t[e] ? r.at(this.of.length + n, e) : NaN;
		});
	}
}, Be = 8, Ve = 120, He = .3, Ue = 2 ** -7, We = class {
	kernel;
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
	phases;
	phasesAtFirst;
	weakest;
	constructor(e, t, n, r, i, a) {
		this.kernel = t, this.values = i, this.inputs = a;
		let o = this.data = e.sketch;
		this.sketch = new A(o, n), this.count = e.kernel.count, this.poses = Array(this.count).fill(null), this.branches = new ze(o, e.drives.map((e) => e.name), t, r, i, a, this.count), this.phases = o.rows.flatMap((e, t) => e.kind === "phase" ? [t] : []);
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
		}, this.weakest = Ke(o), this.home();
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
		let t = I(this.data, this.held.pose, e), { sketch: n } = this;
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
	get current() {
		return !!this.seen?.every((e, t) => e === this.values[t]);
	}
	update() {
		this.current || Ge(this.updating());
	}
	*updating() {
		this.seen = null;
		let { t: e, pose: t } = this.reclose() ? this.held : {
			t: this.base.place,
			pose: null
		};
		this.poses.fill(null), t && (yield* this.follow(e, t)), yield* this.settle(t ?? this.base.pose, e), this.seen = this.values.slice();
	}
	reclose() {
		let e = this.values, t = this.kernel.drives(this.held.t), { sketch: n } = this;
		if (this.loose) {
			n.values = e;
			let t = n.close(this.loose.pose, this.kernel.drives(this.loose.t), He);
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
			let c = n.close(this.held.pose, t, He);
			if (c) this.held = {
				values: s,
				t: this.held.t,
				pose: c
			}, [a, i] = [o, Math.min(1, 2 * i)];
			else if ((i /= 2) < Ue) return !1;
		}
		return !0;
	}
	*follow(e, t) {
		let { course: n, cycle: r } = this.data, i = this.count, a = this.along(e), o = this.kernel.drives(e), s = yield* this.march(new M(t, o), Math.ceil(a), 1, null), c = yield* this.march(new M(t, o), Math.floor(a), -1, null);
		r && !this.phases.length && (s && this.poses[n[i - 1]] && (yield* this.march(s, 0, 1, r)), c && this.poses[n[0]] && (yield* this.march(c, i - 1, -1, r)));
	}
	along(e) {
		let { course: t } = this.data;
		if (Number.isInteger(e) && e < this.count) return t.indexOf(e);
		let n = t.every((e, t) => e === t), r = this.kernel.drives(e)[0];
		return (n ? Math.ceil(e) : t.findIndex((e) => this.kernel.drives(e)[0] > r)) - .5;
	}
	*march(e, t, n, r) {
		let { course: i } = this.data, a = this.count, o = this.data.dimension === 2 ? Math.ceil(a / Ve) : 1, s = (r ?? []).map((e) => n * (r.length > 1 ? e : Math.abs(e))), c = this.counts((e) => s[this.data.drives.indexOf(e)] ?? 0), l = (e) => this.kernel.drives(i[e]).map((e, t) => e + (s[t] ?? 0)), u = (e, t) => {
			r ? this.poses[i[e]] = {
				point: t.point,
				rotation: t.rotation,
				turn: t.turn.map((e, t) => e - c[t])
			} : this.poses[i[e]] = t;
		};
		for (let s = t; s >= 0 && s < a;) {
			if (r && this.poses[i[s]]) return null;
			let t = e.pose, c = e.drives;
			this.sketch.values = this.values;
			let d = Math.min(Math.max(s + n * (o - 1), 0), a - 1);
			if (d !== s && !this.sketch.walk(e, l(d)) && (e = new M(t, c), d = s), d === s && !this.sketch.walk(e, l(s))) return null;
			for (let r = s; r !== d; r += n) u(r, new F(t, e.pose, c, e.drives, l(r)));
			u(d, e.pose), s = d + n, yield;
		}
		return e;
	}
	counts(e) {
		let { data: t } = this, n = new Float64Array(this.held.pose.turn.length), r = /* @__PURE__ */ new Set([t.links.length]);
		if (t.dimension !== 2) {
			for (let r of t.drives) {
				let { count: i } = t.rows[r];
				i !== void 0 && (n[i] += e(r));
			}
			return n;
		}
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
	*settle(e, t) {
		this.spread(this.branches.read(e, t)), yield;
		let n = this.kernel.closes();
		yield;
		let r = this.firstOf(n), i = r < 0 ? null : this.poses[r] ?? this.enter(r, e);
		if (i) {
			if (this.poses[r] || (yield* this.follow(r, i)), this.base = {
				place: r,
				pose: this.exact(r) ?? i
			}, this.poses.every((e) => e)) {
				this.branches.model = this.branches.read(i, r);
				return;
			}
			this.spread(this.branches.read(i, r)), n = this.kernel.closes(), yield, yield* this.behind(n);
		}
		this.spread(this.branches.model), yield, this.kernel.closes();
	}
	spread(e) {
		this.branches.spread(e, this.poses, this.base.pose);
	}
	exact(e) {
		return this.sketch.values = this.values, this.poses[e] && this.sketch.close(this.poses[e], this.kernel.drives(e), .05);
	}
	firstOf(e) {
		let t = (t) => this.poses[t] !== null || e[t] > 0;
		return this.data.places.find(t) ?? e.findIndex((e, n) => t(n));
	}
	enter(e, t) {
		let n = this.data.dimension, r = k(t), i = .1;
		return this.kernel.posed(e).forEach((e, t) => {
			if (!e.every(Number.isFinite)) i = Infinity;
			else {
				for (let i = 0; i < n; i++) r.point[n * t + i] = e[i];
				if (n === 2) r.turn[t] += P(Math.atan2(e[3], e[2]) - r.turn[t]), [r.rotation[2 * t], r.rotation[2 * t + 1]] = [e[2], e[3]];
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
	*behind(e) {
		let { course: t } = this.data, n = (e) => this.poses[t[e]] !== null;
		for (let r = 0; r < this.count; r++) {
			if (n(r) || !e[t[r]]) continue;
			let i = r;
			for (; i + 1 < this.count && !n(i + 1) && e[t[i + 1]] && !this.gapBetween(i);) i++;
			let a = r === 0 || !e[t[r - 1]] && !n(r - 1) || this.gapBetween(r - 1), o = i === this.count - 1 || !n(i + 1) || this.gapBetween(i);
			if (a && o) {
				let e = t[r + i >> 1], n = this.enter(e, this.base.pose);
				n && (yield* this.follow(e, n));
			}
			r = i, yield;
		}
	}
	gapBetween(e) {
		let [t, n] = [this.data.course[e], this.data.course[e + 1]];
		for (let e = 1; e < Be; e++) if (!this.kernel.closesAt(t + e / Be * (n - t))) return !0;
		return !1;
	}
	at(e) {
		this.update();
		let t = Math.floor(e) % this.count, n = e - Math.floor(e) === 0 && this.count <= Ve ? this.poses[t] : null;
		this.sketch.values = this.values;
		for (let r of [t, (t + 1) % this.count]) {
			let t = this.poses[r];
			if (n || !t) continue;
			let i = this.sketch.close(t, this.kernel.drives(r), .05), a = this.nearDrives(r, e);
			n = i && this.sketch.walk(new M(i, this.kernel.drives(r)), a);
		}
		return n && ([this.held, this.loose] = [{
			values: this.values.slice(),
			t: e,
			pose: n
		}, null]), n;
	}
	near(e) {
		if (!this.reclose()) return null;
		if (this.held.t === e) return this.held.pose;
		this.sketch.values = this.values;
		let t = this.sketch.walk(new M(this.held.pose, this.kernel.drives(this.held.t)), this.nearDrives(this.held.t, e));
		return t && (this.held = {
			values: this.values.slice(),
			t: e,
			pose: t
		}), t;
	}
	nearDrives(e, t) {
		let n = this.kernel.drives(t), r = this.kernel.drives(e);
		return n.map((e, t) => this.data.cycle?.[t] ? r[t] + P(e - r[t]) : e);
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
		return e.flatMap((e, i) => t === 2 ? [r.turn[i] + (n[e] ?? 0)] : [...r.point.subarray(3 * i, 3 * i + 3), ...z(r.rotation.subarray(9 * i, 9 * i + 9))]);
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
		let { data: t, sketch: n, kernel: r } = this, i = L(t, this.first.pose, e);
		this.home(), n.values = this.values, n.count(this.phases, !1);
		let a = ((e) => t.drives.map((t) => n.measure(t, e)))(i), o = n.close(i, a, He), s = o && this.placeOf(a);
		if (o && s !== null) {
			let e = r.drives(s).map((e, n) => t.rows[t.drives[n]].angular ? a[n] + P(e - a[n]) : e);
			o = n.walk(new M(o, a), e), o &&= this.wound(o, r.drives(s));
		}
		return o && s !== null && (this.held = {
			values: this.values.slice(),
			t: s,
			pose: o
		}, this.hold(this.phases.map((e) => n.measure(e, o)))), n.count(this.phases, !0), o && s !== null ? s : null;
	}
	placeOf(e) {
		let { kernel: t, data: n, count: r } = this, i = n.drives.map((e) => n.rows[e].angular), a = (r) => Math.hypot(...t.drives(r).map((t, r) => i[r] ? P(t - e[r]) : (t - e[r]) / n.length)), o = 0, s = Infinity;
		for (let e = 0; e < r; e++) a(e) < s && ([o, s] = [e, a(e)]);
		if (e.length !== 1 || s < 1e-12 || t.stepped) return o;
		for (let [n, a] of [
			[o - 1, o],
			[o, o + 1],
			...o === 0 ? [[r - 1, r]] : []
		]) {
			if (n < 0 || a > t.end) continue;
			let [r, o] = [n, a].map((e) => t.drives(e)[0]), s = i[0] ? P : (e) => e, c = s(e[0] - r) / s(o - r);
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
		let [t, ...n] = e, r = k(this.held.pose);
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
};
function Ge(e) {
	for (; !e.next().done;);
}
function Ke(e) {
	let t = (t) => t.ends.filter((t) => t < e.links.length), n = new Set(e.drives.flatMap((n) => t(e.rows[n]))), r = (r) => {
		let i = t(e.rows.find((e) => e.kind === "constraint" && e.joint === r) ?? { ends: [] });
		return i.length - (i.some((e) => n.has(e)) ? .5 : 0);
	};
	return e.gaps.map((e) => e.joint).reduce((e, t) => e && r(e) >= r(t) ? e : t, "");
}
// src/view.ts
var qe = [
	"loads",
	"reactions",
	"inertia",
	"velocities",
	"accelerations",
	"names",
	"traces",
	"values",
	"digits"
], Je = [
	.1,
	.25,
	.5,
	1,
	2,
	4
], Ye = () => ({
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
function Xe(e) {
	let t = [], n = (e, n, r = "") => n !== r && t.push([`~${e}`, n]), r = (t) => qe.filter((n) => e.shown[n] === t).join(" ");
	return n("show", r(!0)), n("hide", r(!1)), e.window && n("window", [e.window.perMm, ...e.window.middle].map((e) => +e.toPrecision(6)).join(" ")), n("tab", e.tab), n("speed", String(e.speed), "1"), n("drag", e.drag, "shape"), n("trace", e.tracers.map((e) => [e.link, ...e.u.map((e) => +e.toPrecision(6))].join(" ")).join("; ")), t;
}
function Ze(e, t) {
	let n = (e) => t.get(`~${e}`) ?? "", r = (e) => e.split(" ").map(Number);
	for (let [t, r] of [["show", !0], ["hide", !1]]) for (let i of qe) n(t).split(" ").includes(i) && (e.shown[i] = r);
	let [i, a, o] = r(n("window"));
	i > 0 && Number.isFinite(i + a + o) && (e.window = {
		perMm: i,
		middle: [a, o]
	}), e.tab = n("tab"), Je.includes(+n("speed")) && (e.speed = +n("speed")), n("drag") === "turn" && (e.drag = "turn"), e.tracers = n("trace").split("; ").flatMap((e) => {
		let [t, ...n] = e.split(" "), r = n.map(Number);
		return r.length > 1 && r.every(Number.isFinite) ? [{
			link: t,
			u: r
		}] : [];
	});
}
function Qe(e, t) {
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
var $e = (e) => e.kind === "joint" || e.kind === "friction" ? "reactions" : e.kind === "inertia" ? "inertia" : "loads", et = [
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
function tt(e) {
	if (!(e > 0) || !Number.isFinite(e)) return 1;
	let t = 10 ** Math.floor(Math.log10(e) + 1e-12);
	return t * (et.find((n) => n * t >= e * (1 - 1e-12)) ?? 10);
}
function nt(e) {
	let t = 10 ** Math.floor(Math.log10(e) + 1e-12);
	return t * ([5, 2].find((n) => n * t <= e * (1 + 1e-12)) ?? 1);
}
function rt(e) {
	let t = (e) => [Math.min(...e), Math.max(...e)], n = t(e.map((e) => e[0])), r = t(e.map((e) => e[1]));
	return Number.isFinite(n[0] + n[1] + r[0] + r[1]) ? {
		x: n,
		y: r
	} : null;
}
var it = (e) => e.t === "hull" || e.t === "path" || e.t === "arc" ? e.p : e.t === "symbol" || e.t === "pair" ? [e.p] : [];
function at(e) {
	return e.items.flatMap((e) => {
		if (e.t === "circle") return [{
			p: e.p,
			reach: (t) => Math.abs(t(e.r))
		}];
		if (e.t === "pair" && e.size) return [{
			p: e.p,
			reach: () => Math.max(...e.size)
		}];
		let t = e.t === "symbol" && e.per_mm ? e.per_mm * Math.max(0, ...[...e.svg.matchAll(/ r="([\d.]+)"/g)].map((e) => +e[1])) : 0;
		return e.t === "symbol" && t ? [{
			p: e.p,
			reach: () => t
		}] : [];
	});
}
function ot(e, t, n) {
	let r = e.kernel, i = Math.max(1, Math.floor(r.count / 72)), a = [], o = t.items.flatMap(it);
	for (let t = 0; t < r.count; t += i) {
		if (!r.good[t]) continue;
		let i = (e) => r.value(e, t);
		for (let t of o) a.push(e.seen(t, i));
		a.push(...st(e, n, i));
	}
	return rt(a);
}
var st = (e, t, n) => t.flatMap(({ p: t, reach: r }) => [-1, 1].map((i) => e.seen(t, n).map((e) => e + i * r(n)))), ct = (e) => e.items.some((e) => e.t === "pair"), lt = class {
	arrow;
	line;
	text;
	constructor(e, t = !1) {
		this.arrow = t;
		let n = r("g", e, { class: "scale" });
		this.line = r("path", n, {
			class: "l-axis",
			style: "fill:none"
		}), this.text = r("text", n, {
			class: "l-note-t",
			"font-size": 2.8
		});
	}
	set([r, i], c, l) {
		let u = c / l.size, d = u > 0 && Number.isFinite(u);
		if (e(this.line, "visibility", d ? "visible" : "hidden"), !d) return t(this.text, ""), r;
		let f = nt(26 * u), p = r + f / u, h = `${o(f)} ${l.unit}`, g = `M${a(r)} ${a(i - 1)}v2`, _ = this.arrow ? `M${a(p - 2.4)} ${a(i - .8)}L${a(p)} ${a(i)}L${a(p - 2.4)} ${a(i + .8)}` : `M${a(p)} ${a(i - 1)}v2`;
		return e(this.line, "d", g + s([[r, i], [p, i]]) + _), t(n(this.text, {
			x: a(p + 1.4),
			y: a(i + 1)
		}), h), p + 1.4 + m(h, 2.8);
	}
};
function ut(e, t, n, i) {
	return r("svg", e, {
		viewBox: `${-t / 2} ${-n / 2} ${t} ${n}`,
		role: "group",
		"aria-label": i
	});
}
var dt = 8, ft = 20;
function pt(t, i, a, o, s, c, l, u, d, f = []) {
	let p = {
		length: l.length.size,
		force: l.force.size
	}, m = ut(t, s, c, u), h = new xe(i, a.per_mm, l, ct(a) ? d.camera : null), g = [], _ = [], v = a.labels.filter((e) => e.kind === "joint").length > dt, y = (e) => o && e !== "values" ? !0 : d.shown[e] ?? Qe(e, v), b = a.force, x = {
		perMm: a.per_mm,
		middle: a.middle ?? [0, 0]
	};
	a.middle && (h.middle = a.middle);
	let S = r("g", m), C = r("g", m), w = r("g", m), T = r("g", m);
	for (let e of a.items) (e.t === "trace" ? g : _).push(Se(e.t === "trace" ? S : C, e, h));
	let E = a.arrows.map((e) => ({
		a: Ne(w, e, h, () => b, o ?? void 0),
		layer: $e(e)
	})), D = new lt(T), O = new lt(T, !0), k = a.arrows.filter((e) => e.t === "force"), A = (f.length ? ["velocities", "accelerations"] : []).map((e) => {
		let t = e === "velocities" ? "speed" : "acceleration", n = e === "velocities" ? "velocity" : "acceleration", r = n[0], i = {
			layer: e,
			unit: l[t],
			rows: f.map((e) => r === "v" ? e.v : e.a),
			perMm: NaN,
			bar: new lt(T, !0)
		};
		return f.forEach((a, o) => {
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
			E.push({
				a: Ne(w, s, h, () => i.perMm, void 0, t),
				layer: e
			});
		}), i;
	}), j = a.labels.map((e) => ({
		l: he(T, e.role, e.text, e.kind === "joint" ? 3.8 : 3.3),
		p: e.p,
		q: e.q
	})), M = at(a), N = Math.max(1, Math.floor(i.count / 72)), P = (e) => [(e.x[0] + e.x[1]) / 2, (e.y[0] + e.y[1]) / 2], F = o ? [
		...o,
		...a.arrows.map((e) => e.p),
		...a.items.flatMap((e) => e.t === "symbol" ? [e.p] : [])
	] : [];
	function I(e) {
		return rt([...F.map((t) => h.seen(t, e)), ...st(h, M, e)]);
	}
	function L() {
		return Array.from({ length: Math.ceil(i.count / N) }, (e, t) => t * N).flatMap((e) => {
			let t = i.good[e] ? I((t) => i.value(t, e)) : null;
			return t ? [{
				k: e,
				b: t
			}] : [];
		});
	}
	function R() {
		let e = i.largest((e) => Math.max(0, ...k.map((t) => Math.hypot(...t.f.map((t) => i.value(t, e)))))) / (o ? 26 : Math.min(Math.max(.18 * Math.min(s, 1.3 * c), 16), 40));
		for (let { k: t, b: n } of o ? L() : []) for (let r of k) {
			let a = (e) => i.value(e, t), o = h.seen(r.p, a), l = h.seen(r.f, a);
			[s / 2 - 9, c / 2 - 12].forEach((t, r) => {
				let i = r ? (n.y[0] + n.y[1]) / 2 : (n.x[0] + n.x[1]) / 2, a = t - Math.abs(o[r] - i) / h.perMm;
				e = Math.max(e, Math.abs(l[r]) / Math.max(a, 4));
			});
		}
		return e > 0 ? tt(e / p.force) * p.force : b;
	}
	function z(e, t = !1) {
		let n = o ? L().map(({ b: e }) => e) : [ot(h, a, M)].filter((e) => e !== null), r = o ? [46, 40] : [s - Math.max(.22 * s, 34), c - Math.max(.22 * c, 30)], l = Math.max(0, ...n.flatMap((e) => [(e.x[1] - e.x[0]) / r[0], (e.y[1] - e.y[0]) / r[1]])), u = t && n.length > 0 && V(n[0], l);
		!u && !o && n.length && (x.middle = P(n[0])), !u && l > 0 && (x.perMm = tt(l / p.length) * p.length), b = e ?? R(), !u && !o && n.length && B(n[0]);
		for (let e of A) {
			let t = i.largest((t) => Math.max(0, ...e.rows.map((e) => Math.hypot(...e.map((e) => i.value(e, t))))));
			e.perMm = t > 0 ? tt(t / ft / e.unit.size) * e.unit.size : NaN;
		}
		H();
	}
	function B(e) {
		let t = [[[e.x[0], e.y[0]], [0, 0]], [[e.x[1], e.y[1]], [0, 0]]], n = k.filter((e) => y($e(e)));
		for (let e = 0; e < i.count; e += N) {
			let r = (t) => i.value(t, e);
			for (let { p: a, f: o } of i.good[e] ? n : []) t.push([h.seen(a, r), h.seen(o, r)]);
		}
		let r = [[s / 2 - 8, s / 2 - 8], [c / 2 - 12, c / 2 - 8]];
		for (let e = 0; e < 9; e++) {
			let e = [0, 1].map((e) => t.map(([t, n]) => t[e] / x.perMm + n[e] / b).filter(Number.isFinite)).map((e) => [Math.min(...e), Math.max(...e)]);
			if (e.every(([e, t], n) => t - e <= r[n][0] + r[n][1])) {
				x.middle = e.map(([e, t], n) => Math.min(Math.max(x.middle[n] / x.perMm, t - r[n][1]), e + r[n][0]) * x.perMm);
				return;
			}
			x.perMm = tt(1.01 * x.perMm / p.length) * p.length;
		}
	}
	function V(e, t) {
		let n = (e, t, n) => Math.max(...e.map((e) => Math.abs(e - t))) < x.perMm * n;
		return t > .5 * x.perMm && n(e.x, x.middle[0], s / 2 - 8) && n(e.y, x.middle[1], c / 2 - 10);
	}
	function H() {
		let e = o ? x : d.window ?? x;
		h.perMm = e.perMm, o || (h.middle = [...e.middle]);
	}
	function U() {
		let e = [
			[
				D,
				h.perMm,
				l.length
			],
			[
				O,
				k.length ? b : NaN,
				l.force
			],
			...A.map((e) => [
				e.bar,
				y(e.layer) && !o ? e.perMm : NaN,
				e.unit
			])
		], [t, n] = [-s / 2 + 2, c / 2 - 2.6];
		for (let [r, i, a] of e) {
			t > -s / 2 + 2 && t + 46 > s / 2 && ([t, n] = [-s / 2 + 2, n - 5]);
			let e = r.set([t, n], i, a);
			e > t && (t = e + 5);
		}
	}
	function W() {
		let t = new _e([
			-s / 2,
			-c / 2,
			s / 2,
			c / 2 - 6
		]), n = ([e, t]) => Math.abs(e) < s / 2 && Math.abs(t) < c / 2;
		for (let e of [..._, ...E.map((e) => e.a)]) e.mark?.(t);
		for (let { l: r, p: i, q: a } of j) {
			let o = h.point(i), s = a ? h.point(a) : o, c = (y("names") || !!a && d.shown.names === void 0) && n([(o[0] + s[0]) / 2, (o[1] + s[1]) / 2]);
			if (e(r.el, "visibility", c ? "visible" : "hidden"), !c) continue;
			let l = (a ? [
				.5,
				.35,
				.65
			] : [0]).map((e) => [o[0] + e * (s[0] - o[0]), o[1] + e * (s[1] - o[1])]);
			t.put({
				label: r,
				anchors: l,
				away: a ? void 0 : o,
				leave: a ? .8 : 1.3
			});
		}
		for (let { a: r } of E) {
			let a = i.solved ? r.anchor() : null;
			!a || !n(a[0]) ? e(r.label.el, "visibility", "hidden") : t.put({
				label: r.label,
				anchors: a.slice(0, -1),
				away: a[a.length - 1],
				leave: .9
			});
		}
	}
	function* G() {
		for (let e of g) e.update(), yield;
	}
	return {
		svg: m,
		paper: h,
		parts: G,
		fit: z,
		need: R,
		look: H,
		on: y,
		force: () => b,
		fitted: () => x.perMm,
		resize(e, t) {
			[s, c] = [e, t], m.setAttribute("viewBox", `${-s / 2} ${-c / 2} ${s} ${c}`);
		},
		update(e) {
			if (h.values = y("values"), n(S, { display: y("traces") ? "inline" : "none" }), e && Ge(G()), n(w, { visibility: i.solved ? "visible" : "hidden" }), U(), i.finite) {
				o && (h.middle = P(I((e) => i.here[e]) ?? {
					x: [0, 0],
					y: [0, 0]
				}));
				for (let e of _) e.update();
				for (let { a: e, layer: t } of E) y(t) ? e.update() : e.hide();
				W();
			}
		}
	};
}
// src/menu.ts
function mt(e, [t, n], r) {
	if (e.querySelector(".menu")?.remove(), !r.length) return;
	let a = document.activeElement, o = i("div", e, {
		class: "menu",
		role: "menu",
		"aria-label": "of this place"
	}), s = () => {
		o.isConnected && (o.remove(), document.removeEventListener("pointerdown", c, !0), a?.focus?.());
	}, c = (e) => {
		e.composedPath().includes(o) || s();
	}, l = r.map(({ said: e, act: t }) => {
		let n = i("button", o, {
			type: "button",
			role: "menuitem"
		}, e);
		return n.addEventListener("click", () => (s(), t())), n;
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
	o.style.left = `${Math.max(4, Math.min(t, window.innerWidth - u - 4))}px`, o.style.top = `${Math.max(4, Math.min(n, window.innerHeight - d - 4))}px`, document.addEventListener("pointerdown", c, !0), l[0].focus({ preventScroll: !0 });
}
// src/viewport.ts
var ht = 1e4, gt = 12, _t = 1.25;
function vt(e, t, n, r, i, a) {
	let { svg: o, paper: s } = e, c = /* @__PURE__ */ new Map(), u = !1, d = (n, r) => {
		let i = e.fitted();
		n > i / ht && n < i * ht && r.every(Number.isFinite) && (t.window = {
			perMm: n,
			middle: r
		}, e.look(), a());
	}, f = ([e, t]) => d(s.perMm, [s.middle[0] - e * s.perMm, s.middle[1] + t * s.perMm]), p = (e, t = [0, 0]) => {
		let [n, r] = s.metres(t), i = s.perMm / e;
		d(i, [n - t[0] * i, r + t[1] * i]);
	}, m = () => {
		t.window = null, e.look(), a();
	};
	o.addEventListener("wheel", (e) => {
		if (!n && !e.ctrlKey && !e.metaKey) return;
		e.preventDefault();
		let t = e.deltaMode === 1 ? 16 : 1;
		p(Math.exp(-e.deltaY * t * (e.ctrlKey ? .01 : .0015)), l(o, e));
	}, { passive: !1 }), o.addEventListener("pointerdown", (e) => {
		e.pointerType === "mouse" && e.button > 1 || (c.size || e.button === 1 || r(e)) && (e.button === 1 && e.preventDefault(), o.setPointerCapture(e.pointerId), c.set(e.pointerId, l(o, e)), u = !1);
	}), o.addEventListener("pointermove", (e) => {
		let t = c.get(e.pointerId);
		if (!t) return;
		let n = l(o, e), r = [n[0] - t[0], n[1] - t[1]];
		u = !0;
		let a = [...c].find(([t]) => t !== e.pointerId)?.[1];
		if (c.set(e.pointerId, n), a) {
			let e = (e) => Math.hypot(e[0] - a[0], e[1] - a[1]) || 1;
			p(e(n) / e(t), a);
		} else i && !e.shiftKey && e.buttons !== 4 ? i(r) : f(r);
	});
	let h = (e) => void c.delete(e.pointerId);
	return o.addEventListener("pointerup", h), o.addEventListener("pointercancel", h), o.addEventListener("lostpointercapture", h), o.addEventListener("dblclick", (e) => {
		r(e) && m();
	}), o.addEventListener("click", (e) => u && e.stopImmediatePropagation(), { capture: !0 }), o.tabIndex = 0, o.addEventListener("keydown", (e) => {
		if (e.target !== o || e.ctrlKey || e.metaKey || e.altKey) return;
		let t = {
			ArrowLeft: [gt, 0],
			ArrowRight: [-12, 0],
			ArrowUp: [0, gt],
			ArrowDown: [0, -12]
		};
		if (t[e.key]) f(t[e.key]);
		else if (e.key === "+" || e.key === "=") p(_t);
		else if (e.key === "-") p(1 / _t);
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
var yt = 3.6, bt = 5.2, xt = 550, St = 8;
function Ct(e, t, n, a, o, s) {
	let c = i("div", e, { class: "paper" }), u = pt(c, t, n, null, 170, 119, a, "the mechanism", o, s.rates ?? []), { svg: d } = u, f = r("g", d, { class: "overlay" }), p = u.paper.axes.length > 2, m = (e) => {
		let t = e.target.closest("[data-item]")?.dataset.item;
		return t ? G(t) : null;
	}, h = (e) => !v(e.clientX, e.clientY, e.pointerType === "touch" ? 14 : 6).some(s.held), g = () => {
		s.on?.({
			type: "view",
			view: o
		}), s.again(!0);
	}, _ = p ? (e) => (u.paper.turn(-.045 * e[0], .045 * e[1]), g()) : null, v = (e, t, n = 6) => te(d, e, t, n), y = vt(u, o, !!s.full, h, _, g);
	p && (d.style.cursor = "move");
	let b = (e, t) => u.paper.metres(l(d, {
		clientX: e,
		clientY: t
	})), x = (e) => {
		o.chosen = e, ne(d, e), s.chosen(e);
	}, S = (e) => [e.clientX, e.clientY];
	d.addEventListener("click", (e) => {
		let t = v(e.clientX, e.clientY, e.pointerType === "touch" ? 14 : 6), n = t.length ? t : m(e) ? [m(e)] : [];
		s.on?.({
			type: "select",
			items: n,
			at: S(e),
			point: b(e.clientX, e.clientY)
		}) || x(n[0] && !ee(n[0], o.chosen) ? n[0] : null);
	});
	let C = (t, n) => {
		let r = b(...n);
		t[0] && x(t[0]), s.on?.({
			type: "menu",
			items: t,
			at: n,
			point: r
		}) || mt(e.closest(".dalembert") ?? document.body, n, s.entries(t, r));
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
		clearTimeout(w), e.pointerType === "touch" && e.isPrimary && (T = S(e), w = window.setTimeout(() => C(v(e.clientX, e.clientY, 14), T), xt));
	}, { capture: !0 });
	let E = () => clearTimeout(w);
	d.addEventListener("pointermove", (e) => Math.hypot(e.clientX - T[0], e.clientY - T[1]) > St && E(), { capture: !0 });
	for (let e of ["pointerup", "pointercancel"]) d.addEventListener(e, E, { capture: !0 });
	return {
		m: u,
		paper: c,
		view: y,
		overlay: f,
		hit: v,
		metres: b,
		choose: x,
		resize() {
			let { width: e, height: t } = c.getBoundingClientRect();
			if (!(e > 0 && t > 0)) return;
			let n = Math.min(Math.max(Math.min(e / 170, t / 105), yt), bt);
			u.resize(e / n, t / n);
		}
	};
}
// src/switches.ts
var wt = {
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
function Tt(e, t) {
	let n = i("label", e, { title: t.title }), r = i("input", n, { type: "checkbox" });
	r.checked = t.on, n.append(t.said), r.addEventListener("change", () => t.act(r.checked));
}
function Et(e, t, n, r, i) {
	for (let a of n) {
		let [n, o] = wt[a];
		Tt(e, {
			said: n,
			title: o,
			on: t.shown[a] ?? Qe(a, r),
			act: (e) => (t.shown[a] = e, i())
		});
	}
}
function Dt(e, t, n, r, a) {
	let o = i("span", e, {
		class: "group",
		role: "group",
		"aria-label": "view"
	}), s = (e, t, n) => {
		let r = i("button", o, {
			type: "button",
			title: t,
			.../^\w/.test(e) ? {} : { "aria-label": t }
		}, e);
		return r.addEventListener("click", n), r;
	};
	if (s("−", "zoom out (-)", () => t.zoom(.8)), s("+", "zoom in (+)", () => t.zoom(1.25)), s("fit", "the whole mechanism (0)", () => t.fit()), !r) return;
	let c = i("span", e, {
		class: "group",
		role: "group",
		"aria-label": "dragging"
	}), l = ["shape", "turn"].map((e) => {
		let t = i("button", c, {
			type: "button",
			title: e === "shape" ? "dragging a joint changes the mechanism" : "dragging a joint or a link turns the mechanism"
		}, e === "shape" ? "reshape" : "turn");
		return t.addEventListener("click", () => {
			n.drag = e, u(), a();
		}), {
			way: e,
			b: t
		};
	}), u = () => l.forEach(({ way: e, b: t }) => t.setAttribute("aria-pressed", String(n.drag === e)));
	u();
}
// src/tools.ts
var Ot = class {
	b;
	data;
	kernel;
	on = !1;
	arrows;
	constructor(e, t, n) {
		this.b = e, this.data = t, this.kernel = n;
		let i = r("g", e.svg, { class: "gradient" }), a = t.gradient ? t.handles.flatMap((e) => "ends" in e && e.ends.length ? [e] : []) : [];
		this.arrows = a.map((e) => ({
			p: e.p,
			ends: e.ends,
			arrow: new g(i, "acceleration", `lower the peak by ${e.name}`)
		}));
	}
	peak(e) {
		let t = this.kernel, n = (n) => Math.abs(t.value(e.row, n)), r = t.largest(n), i = Math.max(0, t.good.findIndex((e, t) => e > 0 && n(t) === r));
		return {
			k: i,
			size: r,
			where: t.count > 1 ? ` at ${kt(this.data, t, i)}` : ""
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
}, kt = (e, t, n) => e.drives.map((e) => `${e.name} = ${o(t.position(e.name, n) / e.size, 5)}${e.unit === "°" ? "" : " "}${e.unit}`).join(", "), At = class {
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
}, jt = class {
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
function Mt(e, t) {
	let n = e.numbers.flatMap((e, n) => t.values[n] === e.value ? [] : [[e.path, t.values[n]]]), r = n.length ? t.motion.assembly() : [];
	return Object.fromEntries([...n, ...r.map((t, n) => [e.sketch.assembly[n], t])]);
}
function Nt(e, t, n) {
	let r = new URLSearchParams({ t: String(+n.t.toFixed(4)) });
	for (let [e, t] of Xe(n)) r.set(e, t);
	for (let [n, i] of Object.entries(Mt(e, t))) r.set(n, String(i));
	return r.toString();
}
function Pt(e, t, n, r) {
	let i = new Map(new URLSearchParams(r.replace(/^#/, ""))), a = {};
	Ze(n, i);
	for (let [e, t] of i) e !== "t" && !e.startsWith("~") && (a[e] = t.trim() ? Number(t) : NaN);
	t.change(a);
	let o = Number(i.get("t") ?? NaN);
	Number.isFinite(o) && (n.t = Math.min(Math.max(o, 0), e.end));
}
function Ft(e, t) {
	let n = [...t.values, ...t.motion.assembly()], r = e.numbers.map((e, n) => e.value !== t.values[n]), i = r.includes(!0);
	return e.template.map((e) => typeof e == "string" ? e : e.was !== void 0 && !e.of?.some((e) => r[e] ?? i) ? e.was : e.now.map((e) => typeof e == "string" ? e : String(n[e[0]] / e[1])).join("")).join("");
}
function It(e, t) {
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
function Lt(e, t) {
	let i = e.cloneNode(!0), { width: a, height: o } = e.viewBox.baseVal;
	i.querySelectorAll(".handles, .overlay").forEach((e) => e.remove()), n(i, {
		xmlns: "http://www.w3.org/2000/svg",
		width: `${a}mm`,
		height: `${o}mm`,
		"font-family": "'DejaVu Sans', Arial, sans-serif"
	});
	let s = r("style", null);
	return s.textContent = t, i.prepend(s), new XMLSerializer().serializeToString(i);
}
var Rt = 300 / 25.4;
async function zt(e, t) {
	let { width: n, height: r } = e.viewBox.baseVal, i = new Image(), a = URL.createObjectURL(new Blob([Lt(e, t)], { type: "image/svg+xml" }));
	try {
		i.src = a, await i.decode();
		let e = document.createElement("canvas"), t = e.getContext("2d");
		return [e.width, e.height] = [Math.round(n * Rt), Math.round(r * Rt)], t.fillStyle = "#fff", t.fillRect(0, 0, e.width, e.height), t.drawImage(i, 0, 0, e.width, e.height), await new Promise((t, n) => e.toBlob((e) => e ? t(e) : n(/* @__PURE__ */ Error("the picture is too large")), "image/png"));
	} finally {
		URL.revokeObjectURL(a);
	}
}
function X(e, t, n) {
	let r = document.createElement("a");
	r.href = URL.createObjectURL(new Blob([t], { type: n })), r.download = e, r.click(), setTimeout(() => URL.revokeObjectURL(r.href), 1e3);
}
var Bt = (e) => d(e).toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "").slice(0, 60) || "mechanism", Vt = class {
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
}, Ht = .02, Ut = 2, Wt = 500;
async function Gt(e, t, c, u) {
	let [d, f] = await Promise.all([U.create(t.sketch.closure, 1), U.create(t.shown, 1)]), p = t.sketch, m = {
		point: Float64Array.from(p.pose.point),
		rotation: Float64Array.from(p.pose.rotation),
		turn: Float64Array.from(p.pose.turn)
	}, g = new Vt(t, f), _ = new pe(p, d, L(p, m, u.pose ?? {})), b = [], x = new y(p.links, t.poses, g), S = [], C = [], w = null, T = [], E = "there", D = 0, O = _.pose;
	g.show(_.pose);
	let A = i("header", e);
	i("h1", A, {}, t.title);
	let j = i("div", A, {
		class: "bar",
		role: "toolbar",
		"aria-label": "sketch"
	}), M = (e, t, n, r) => {
		let a = i("button", e, {
			type: "button",
			title: n,
			.../^\w/.test(t) ? {} : { "aria-label": n }
		}, t);
		return a.addEventListener("click", r), a;
	};
	i("output", j, { class: "readout" }, "Sketch: drag the links.").style.flex = "1", u.back && M(j, "Back", "undo the last addition", u.back);
	let N = M(j, "↶", "undo (Ctrl+Z)", () => q(S, C)), P = M(j, "↷", "redo (Ctrl+Y)", () => q(C, S));
	M(j, "Reset", "as in the file", () => K(() => _.placed(k(m))));
	let F = i("section", i("main", e, { class: "one" }), {
		class: "stage",
		"aria-label": "sketch"
	}), I = Ct(F, g, t.views.mechanism, t.units, c, {
		full: u.full,
		on: u.on,
		entries: oe,
		chosen: () => J(),
		again: () => J(),
		held: (e) => te(`${e.kind}:${e.name}`) >= 0
	}), { m: R, paper: z } = I, B = v(R, t, g), V = r("g", R.svg, { class: "handles" }), W = r("g", R.svg, {
		class: "gaps",
		"pointer-events": "none"
	}), G = ne().map(({ link: e, point: t, p: n }) => {
		let i = r("circle", V, {
			class: "handle joint",
			r: 2.2,
			tabindex: 0,
			role: "slider",
			"aria-label": `pull ${t} of ${e}`,
			"aria-valuetext": `${t} of ${e}`,
			"aria-valuenow": 0,
			"data-item": `point:${e}.${t}`
		});
		return r("title", i).textContent = `drag ${t} of ${e}`, i.addEventListener("keydown", (t) => {
			let r = {
				ArrowLeft: [-1, 0],
				ArrowRight: [1, 0],
				ArrowUp: [0, -1],
				ArrowDown: [0, 1]
			}[t.key];
			if (!r) return;
			t.preventDefault(), t.stopPropagation();
			let i = Ut * (t.shiftKey ? 5 : 1), a = R.paper.point(n);
			K(() => {
				let t = {
					link: p.links.indexOf(e),
					u: x.local(R.paper, p.links.indexOf(e), a)
				};
				_.frame(t, R.paper.metres([a[0] + i * r[0], a[1] + i * r[1]]), ue());
			});
		}), {
			knob: i,
			p: n
		};
	}), ee = i("div", null, {
		class: "missing",
		role: "status"
	});
	z.before(ee), i("p", ee, {}, t.missing.sentence[0].toUpperCase() + t.missing.sentence.slice(1) + ".");
	for (let e of t.missing.offers) M(ee, `+ ${e.said}`, e.page ? e.said : "add it and save the model file", () => void se(e));
	re();
	function te(e) {
		return e.startsWith("point:") ? p.links.indexOf(e.slice(6, e.lastIndexOf("."))) : ie(t, e);
	}
	function ne() {
		let e = /* @__PURE__ */ new Set();
		return t.points.filter(({ p: t }) => {
			let n = t.map((e) => g.here[e].toFixed(9)).join();
			return !e.has(n) && e.add(n);
		});
	}
	function re() {
		let e = i("div", F, { class: "switches" }), n = Bt(t.title);
		Dt(e, I.view, c, !1, () => J()), Et(e, c, t.views.mechanism.arrows.length ? ["names", "loads"] : ["names"], !1, () => J());
		let r = i("span", e, {
			class: "group",
			role: "group",
			"aria-label": "save"
		});
		M(r, "Model file", "the file with the pose that is drawn", () => X(`${n}.yaml`, ce(), "text/yaml")), M(r, "SVG", "the drawing", () => X(`${n}.svg`, Lt(R.svg, t.style.light), "image/svg+xml")), M(r, "PNG", "the drawing", () => void zt(R.svg, t.style.light).then((e) => X(`${n}.png`, e, "image/png")));
	}
	function oe(e) {
		return e.flatMap(({ kind: e, name: t }) => p.rows.flatMap((n, r) => e === "joint" && n.joint === t && n.kind === "freedom" ? [{
			said: `${_.locked(r) ? "Release" : "Lock"} the ${n.angular ? "turn" : "slide"} of ${t}`,
			act: () => _.lock(r, !_.locked(r))
		}] : []));
	}
	async function se(e) {
		if (!u.on?.({
			type: "offer",
			offer: e
		})) {
			if (!e.page) return X(`${Bt(t.title)}.yaml`, e.text, "text/yaml");
			await u.taken(JSON.parse(new TextDecoder().decode(await H(e.page))), le());
		}
	}
	function ce() {
		let e = p.links.flatMap((e, t) => [
			_.pose.point[2 * t],
			_.pose.point[2 * t + 1],
			_.pose.turn[t]
		]);
		return t.text.replace(/@@(\d+)@@/g, (t, n) => String(e[+n]));
	}
	function le() {
		return Object.fromEntries(p.links.map((e, t) => [e, [
			_.pose.point[2 * t],
			_.pose.point[2 * t + 1],
			_.pose.turn[t]
		]]));
	}
	let ue = () => Ht * R.paper.perMm / p.length;
	function K(e) {
		O = _.pose, e(), de();
	}
	function de() {
		O !== _.pose && (S.push(O), S.length > Wt && S.shift(), C.length = 0), u.on?.({
			type: "pose",
			pose: le(),
			closed: _.closed
		}), J();
	}
	function q(e, t) {
		let n = e.pop();
		n && (t.push(_.pose), _.placed(n), J());
	}
	R.svg.addEventListener("pointerdown", (e) => {
		let t = e.button === 0 ? ae(R.svg, e, te) : -1;
		if (t < 0) return;
		R.svg.setPointerCapture(e.pointerId);
		let n = l(R.svg, e);
		[w, T, O] = [
			{
				link: t,
				u: x.local(R.paper, t, n)
			},
			R.paper.metres(n),
			_.pose
		];
	}), R.svg.addEventListener("pointermove", (e) => {
		w && R.svg.hasPointerCapture(e.pointerId) && (T = R.paper.metres(l(R.svg, e)), E = "on the way", J());
	});
	let fe = () => {
		w && (w = null, E = "there", de());
	};
	R.svg.addEventListener("pointerup", fe), R.svg.addEventListener("pointercancel", fe);
	function J() {
		D ||= requestAnimationFrame(() => {
			D = 0;
			let e = performance.now();
			Y(), b.push(performance.now() - e), b.length > 2e3 && b.shift();
		});
	}
	function Y() {
		if (w || !_.closed) {
			let e = _.pose;
			E !== "on the way" && _.closed || (E = _.frame(w, T, ue())), (E === "on the way" || E === "apart" && e !== _.pose) && J();
		}
		g.show(_.pose), R.update(!0);
		for (let { knob: e, p: t } of G) {
			let [r, i] = R.paper.point(t);
			n(e, {
				cx: a(r),
				cy: a(i)
			});
		}
		B(), me(), [N.disabled, P.disabled] = [!S.length, !C.length];
	}
	function me() {
		if (W.replaceChildren(), !w || E !== "nearest" || _.away < 3 * ue()) return;
		let [e, i] = [_.at(w), T].map((e) => R.paper.of(...R.paper.project(e))), { unit: c, size: l } = t.units.length;
		r("path", W, {
			class: "l-gap",
			d: s([e, i]),
			style: "fill:none"
		}), n(h(W, "gap", `${o(_.away * p.length / l, 3)} ${c} too far`, 3.3, i[0] < e[0] == i[1] < e[1] ? "start" : "end"), {
			x: a((e[0] + i[0]) / 2 + (i[0] < e[0] == i[1] < e[1] ? 2.5 : -2.5)),
			y: a((e[1] + i[1]) / 2 - 1.5)
		});
	}
	let he = u.full ? document : e, ge = (e) => {
		let t = e;
		(t.ctrlKey || t.metaKey) && !t.altKey && /^[zy]$/i.test(t.key) && (t.preventDefault(), t.key.toLowerCase() === "z" && !t.shiftKey ? q(S, C) : q(C, S));
	};
	he.addEventListener("keydown", ge);
	let _e = () => {
		I.resize(), R.fit(), J();
	};
	return {
		data: t,
		times: b,
		stage: I,
		observed: [z],
		resize: _e,
		redraw: J,
		opened() {
			_e(), Y(), I.choose(c.chosen);
		},
		set: () => void 0,
		show: () => void 0,
		text: ce,
		pose: le,
		sketch: _,
		remove: () => he.removeEventListener("keydown", ge)
	};
}
// src/reading.ts
var Z = class extends Error {}, Q = (e, t) => e.replace(/\{(\w+)\}/g, (e, n) => t[n] ?? e);
function $(e) {
	if (/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(e)) return e;
	let t = e.includes("'") && !e.includes("\"") ? "\"" : "'", n = t + e.replace(/\\/g, "\\\\") + t;
	return n.length <= 60 ? n : n.slice(0, 57) + "...";
}
var Kt = {
	"²": "^2",
	"³": "^3",
	"·": "*",
	"⋅": "*",
	"×": "*",
	"−": "-"
}, qt = class {
	text;
	reading;
	units;
	tokens;
	constructor(e, t, n) {
		this.text = e, this.reading = t, this.units = n;
		let r = e.replace(/[²³·⋅×−]/g, (e) => Kt[e]).replaceAll("**", "^");
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
function Jt(e, t, n) {
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
	let p = new qt(d, n, a.units).read(), m = [...p.dimension];
	if (a.per_radian && m[3] === 0 && (m[3] = a.dimension[3]), m.some((e, t) => e !== a.dimension[t])) {
		let e = Object.values(r).find((e) => e.dimension.every((e, t) => e === p.dimension[t]))?.phrase ?? Yt(p.dimension);
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
function Yt(e) {
	return `in ${[
		"m",
		"kg",
		"s",
		"rad"
	].flatMap((t, n) => e[n] ? [t + (e[n] === 1 ? "" : `^${e[n]}`)] : []).join("*")}`;
}
// src/gate.ts
var Xt = class {
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
			let r = Jt(t, n, this.data.reading);
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
		let { sentences: r } = this.data.reading, i = e.range;
		if (!Number.isFinite(t)) throw new Z(Q(r.finite, { text: n }));
		let a = this.unmet(e, t, n);
		if (a) throw new Z(a);
		if (i && t !== e.value && (t < i[0] || t > i[1])) throw new Z(Q(r.range, {
			text: n,
			low: this.words(e, i[0]),
			high: this.words(e, i[1])
		}));
	}
	following() {
		let { limits: e } = this.data, t = this.kernel.values;
		if (!e.length || t.every((e, t) => e === this.accepted[t])) return "";
		this.kernel.other(t, this.out);
		for (let { row: t, path: n, ...r } of e) {
			let e = this.out[t], i = n.lastIndexOf("."), a = this.unmet(r, e, Number.isInteger(e) ? e.toFixed(1) : String(e));
			if (a) return `${n.slice(0, i)}: ${n.slice(i + 1)}: ${a}`;
		}
		return "";
	}
	unmet({ sign: e, counts: t }, n, r) {
		let { sentences: i, signs: a } = this.data.reading;
		return e && (n < 0 || e === "positive" && n === 0) ? Q(a[e], { text: r }) : t && !Number.isInteger(n) ? Q(i.count, { what: t }) : "";
	}
	words(e, t) {
		return `${o(t / e.size, 6).replace("–", String(t))}${e.unit === "°" ? "" : " "}${e.unit}`.trim();
	}
};
// src/handles.ts
function Zt(e, t, n, i) {
	let a = r("g", e.svg, { class: "handles" }), o = t.handles.map((t) => en(a, e, t, n, i));
	return () => n.finite && o.forEach((e) => e());
}
var Qt = (e, t) => e.reduce((e, n, r) => e + n * t[r], 0);
function $t(e, t, n, r, [i, a]) {
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
function en(e, t, i, o, s) {
	let c = `${{
		joint: "joint",
		point: "point",
		center: "",
		load: "force",
		direction: "direction of"
	}[i.kind]} ${i.name}`.trim(), u = r("circle", e, {
		class: `handle ${i.kind}`,
		r: i.kind === "joint" ? 2.6 : 2,
		tabindex: 0,
		role: "slider",
		"aria-label": `move ${c}`,
		"aria-valuetext": c,
		"aria-valuenow": 0,
		"data-kind": i.kind,
		"data-name": i.name,
		"data-item": i.kind === "center" ? `center:${i.name.split(":")[0]}` : `${i.kind}:${i.name}`
	});
	r("title", u).textContent = `drag ${c}`;
	let d = t.paper, f = o.values, p = (e) => e.map((e) => o.here[e]), m = [], h = [], g = [0, 0], _ = [], v = [], y = [0, 0], b = !1, x = () => {
		let e = d.point(i.p), n = "f" in i ? d.here(i.f) : "along" in i ? d.here(i.along) : [0, 0], r = i.kind === "direction" ? 16 : 1 / t.force();
		return [e[0] + r * n[0], e[1] - r * n[1]];
	}, S = () => {
		let e = (e, t) => ({
			axes: e.map(p),
			at: p(t)
		});
		m = "ends" in i ? i.ends.map((t) => e(t.axes, t.at)) : [e(i.axes, i.p)], [h, g, _, b] = [
			p(i.p),
			x(),
			"f" in i ? p(i.f) : [],
			!0
		], v = "about" in i && i.about ? p(i.about) : [];
	}, C = (e) => d.vector([e[0] - g[0], e[1] - g[1]]), w = (e) => {
		if ("by" in i && i.by) $t(o, d, i.p, i.by, d.metres(e));
		else if ("ends" in i) E(i.ends, T(C(e)));
		else if (i.kind === "direction") {
			let t = d.point(i.p), n = [e[0] - t[0], t[1] - e[1]], [r, a] = m[0].axes.map((e) => Qt(e, n));
			f[i.direction] = tn(Math.atan2(a, r), f[i.direction]);
		} else D(i, C(e).map((e, n) => _[n] + e / d.perMm * t.force()));
		s.changed();
	}, T = (e) => {
		if (!("about" in i) || !i.about) return e;
		let t = v, n = h.map((e, n) => e - t[n]), r = n.map((t, n) => t + e[n]), a = Math.hypot(...n) / (Math.hypot(...r) || 1);
		return r.map((e, n) => t[n] + a * e - h[n]);
	}, E = (e, t) => e.forEach((e, n) => {
		let r = h.map((e, r) => e + t[r] - m[n].at[r]);
		e.n.forEach((e, t) => f[e] = Qt(m[n].axes[t], r));
	}), D = (e, t) => {
		let n = m[0].axes.map((e) => Qt(e, t));
		if (e.components) return e.components.forEach((e, t) => f[e] = n[t]);
		let r = Math.sign(f[e.size]) || 1;
		e.direction === void 0 ? f[e.size] = r * Qt(t, _) / (Math.hypot(..._) || 1) : (f[e.direction] = tn(Math.atan2(r * n[1], r * n[0]), f[e.direction]), f[e.size] = r * Math.hypot(...n));
	}, O = () => {
		b && s.finished(), b = !1;
	};
	return u.addEventListener("pointerdown", (e) => {
		if (e.button !== 0) return;
		e.stopPropagation(), u.setPointerCapture(e.pointerId), S();
		let n = l(t.svg, e);
		y = [g[0] - n[0], g[1] - n[1]];
	}), u.addEventListener("pointermove", (e) => {
		let n = l(t.svg, e);
		b && w([n[0] + y[0], n[1] + y[1]]);
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
		if (i.kind === "direction" && b) return;
		let [e, t] = x();
		n(u, {
			visibility: Number.isFinite(e + t) ? "visible" : "hidden",
			cx: a(e),
			cy: a(t)
		});
	};
}
var tn = (e, t) => e - 2 * Math.PI * Math.round((e - t) / (2 * Math.PI)), nn = 1, rn = 90, an = 1e60, on = class {
	table;
	breaks;
	pieces;
	constructor(e) {
		this.table = e, this.breaks = V(e.breaks), this.pieces = V(e.pieces);
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
}, sn = class e {
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
	cycles = 0;
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
	forces;
	constructor(e, t, n, r, i, a) {
		this.data = e, this.whole = t, this.one = n, this.slope = a, this.count = e.kernel.count, this.row = e.kernel.row, this.values = t.values, this.values.set(e.numbers.map((e) => e.value)), this.rows = t.out, this.good = new Uint8Array(this.count), this.here = new Float64Array(e.kernel.outputs + 1), this.hereAfter = new Float64Array(e.kernel.outputs + 1), this.side = e.kernel.channels.indexOf("side"), this.after = this.side < 0 ? this.rows : this.rows.slice(), [this.read, this.later] = [this.rows, this.after], this.positions = new Map(e.drives.map((e) => [e.name, V(e.position)])), this.channels = new Map(e.channels.map((e) => [e.name, {
			values: V(e.values),
			pieces: e.table && new on(e.table),
			drive: e.table ? e.table.drive : e.name.replace(/^position /, "")
		}]));
		let o = /* @__PURE__ */ new Set([...e.sketch.branches, ...e.sketch.known]);
		this.forces = e.views.mechanism.arrows.flatMap((e) => e.kind === "joint" && e.t === "force" ? e.f : []), this.followed = e.kernel.channels.flatMap((e, t) => o.has(e) || e.startsWith("phase ") ? [{
			name: e,
			channel: t
		}] : []), this.known = new Map(e.sketch.known.map((t, n) => [t, e.sketch.branches.length + n])), e.kernel.channels.forEach((e, n) => {
			let r = this.channels.get(e).values;
			for (let e = 0; e < this.row; e++) t.path[n * this.row + e] = r[Math.min(e, this.count - 1)];
		}), this.side >= 0 && t.path.fill(-1, this.side * this.row, (this.side + 1) * this.row);
		let s = (e) => this.channels.get(e)?.values ?? new Float64Array(this.count);
		this.motion = new We(e, this, r, i, this.values, s), this.cyclic = !e.only_at_positions && e.drives.some((e) => e.turns && this.isWholeTurn(e.name));
	}
	static async create(t) {
		let n = t.numbers.length, [r, i, a, o, s] = await Promise.all([
			U.create(t.kernel, n),
			U.create(t.kernel, n),
			U.create(t.sketch.closure, n),
			U.create(t.sketch.shown, n),
			t.gradient ? U.create(t.gradient, n) : void 0
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
		Ge(this.cycling());
	}
	*parts() {
		let { values: e } = this, t = e.slice(), n = e.slice(), r = this.cycling();
		for (let i = !1; !i;) n.set(e), e.set(t), i = !!r.next().done, e.set(n), yield;
	}
	*cycling() {
		this.motion.current ? this.closes() : yield* this.motion.updating(), this.side >= 0 && this.bothSides();
		let e = this.rows.length - this.row, t = 0, n = (e) => this.rows[e * this.row + t];
		for (; t < this.count; t++) t % rn === 0 && (yield), this.rows[e + t] = this.motion.poses[t] ? this.judged(this.rows[e + t], n) : nn, this.good[t] = +this.numbered(this.markAt(t));
		this.cycles++;
	}
	closes() {
		for (let { name: e, channel: t } of this.followed) this.whole.path.set(this.channels.get(e).values, t * this.row);
		return this.whole.call(this.count), Uint8Array.from({ length: this.count }, (e, t) => +(this.markAt(t) !== nn));
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
		if (this.data.statuses[e]?.status === "contact_lost" && this.forces.every((e) => Math.abs(t(e)) <= this.data.noise.force)) return 0;
		if (e === nn || !this.numbered(e) && this.data.statuses[e].status !== "undecided") return e;
		let n = this.numbered(e) || this.values.some((e) => Math.abs(e) > an);
		for (let e = 0; n && e < this.here.length - 1; e++) if (!Number.isFinite(t(e))) return this.marked("overflow");
		return e;
	}
	marked(e) {
		return this.data.statuses.findIndex((t) => t.status === e);
	}
	closesAt(e) {
		return this.run(e, null, this.motion.branches.model), this.one.at(this.here.length - 1) !== nn;
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
		let t = this.coarse ? this.motion.near(e) : this.motion.at(e), { here: n } = this;
		this.run(e, t, t ? this.motion.branches.read(t, e) : this.motion.branches.model);
		for (let e = 0; e < n.length; e++) [n[e], this.hereAfter[e]] = [this.one.at(e), this.one.at(e, 1)];
		let r = n.length - 1, i = this.side >= 0 ? this.between(n[r], this.hereAfter[r], (e) => n[e] === this.hereAfter[e]) : n[r];
		n[r] = this.judged(i, (e) => n[e]), t || (n[n.length - 1] = nn), this.open = [], t && n.every(Number.isFinite) || this.stretch(t ?? this.motion.stretched(e), e), this.finite = this.data.sketch.drawn.every((e) => Number.isFinite(n[e]));
	}
	stretch(e, t) {
		let { sketch: n } = this.data, r = this.motion.branches.look(e, t, this.motion.branches.model), i = n.branches.length + n.known.length;
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
		let a = r && this.data.sketch.known.length ? this.motion.branches.look(r, n, i) : null;
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
		this.feed(r, n.channels, t, i, Float64Array.from(this.motion.branches.of, (e) => e[t])), r.values.set(this.values), r.call(1);
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
function cn(e, t, n, r, a) {
	let o = [], s = /* @__PURE__ */ new Map(), c = (t) => {
		let n = s.get(t);
		if (!n) {
			let r = i("fieldset", e);
			i("legend", r, {}, t), s.set(t, n = r);
		}
		return n;
	}, l = t.numbers.map((e, t) => ({
		field: e,
		n: t
	})).sort((e, t) => Number(t.field.parameter ?? !1) - Number(e.field.parameter ?? !1));
	for (let { field: e, n: t } of l) {
		let [s, l] = e.parameter ? ["Parameters", e.label] : ln(e.label), f = i("label", c(s), { title: e.about ?? e.path });
		i("span", f, {}, l);
		let p = i("input", f, {
			type: "text",
			inputmode: "decimal",
			autocomplete: "off",
			spellcheck: "false",
			"aria-label": e.label,
			"data-path": e.path
		});
		i("span", f, { class: "unit" }, e.unit);
		let m = i("span", f, {
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
			let e = r.type(t, p.value);
			g(e), e || (p.value = u(h), a(!0));
		}), p.addEventListener("keydown", (e) => {
			e.key === "Escape" && (g(""), p.value = u(h), p.blur());
		}), e.parameter) {
			let [r, o] = e.range ?? un(e.value), s = i("input", f, {
				type: "range",
				min: r / e.size,
				max: o / e.size,
				step: "any",
				"aria-label": `${e.label}, slider`
			});
			h.slide = s;
			let c = (r) => () => {
				n.values[t] = +s.value * e.size, a(r);
			};
			s.addEventListener("input", c(!1)), s.addEventListener("change", c(!0));
		}
		o.push(h);
	}
	let u = (e) => String(+(n.values[e.n] / e.field.size).toPrecision(6)), d = (e) => {
		let t = n.values[e.n] / e.field.size;
		document.activeElement !== e.box && !e.box.hasAttribute("aria-invalid") && (e.box.value = u(e)), e.slide && document.activeElement !== e.slide && (e.slide.value = String(t)), e.box.classList.toggle("changed", n.values[e.n] !== e.field.value);
	};
	return {
		update: () => o.forEach(d),
		focus: (e) => o.find((t) => t.field.path === e)?.box.focus()
	};
}
function ln(e) {
	let t = e.indexOf(": ");
	return t < 0 ? ["Others", e] : [e.slice(0, t), e.slice(t + 2)];
}
function un(e) {
	let t = .5 * Math.abs(e) || 1;
	return [e - t, e + t];
}
function dn(e, n, r) {
	let a = i("tbody", i("table", e, { class: "answers" })), s = n.views.table.map((e) => {
		let t = i("tr", a), r = n.units[e.kind];
		return i("th", t, { scope: "row" }, d(e.name)), {
			r: e,
			unit: r,
			cell: i("td", t)
		};
	});
	return { update() {
		for (let { r: e, unit: n, cell: i } of s) {
			let a = e.rows.map((e) => r.here[e] / n.size), s = (e) => n.unit === "°" ? `${o(e, 5)}°` : `${o(e)} ${n.unit}`;
			t(i, r.solved ? a.length === 1 ? s(a[0]) : `${s(Math.hypot(...a))}${a.length === 2 ? ` at ${o(Math.atan2(a[1], a[0]) * 180 / Math.PI)}°` : ""}  (${a.map((e) => o(e)).join(", ")})` : "–");
		}
	} };
}
function fn(e, t, n, r) {
	let { terms: a, about: s } = r.equations, { force: c, moment: l } = t.units, u = a[0]?.f.length ?? 2, f = [
		"x",
		"y",
		"z"
	].slice(0, u).map((e, t) => ({
		head: `ΣF${e}`,
		unit: c,
		sign: (t) => d(t.name) + e,
		row: (e) => e.f[t]
	}));
	(u === 2 ? [""] : [
		"x",
		"y",
		"z"
	]).forEach((e, t) => f.push({
		head: `ΣM${e} about ${s}`,
		unit: l,
		sign: (t) => `M${e}(${d(t.name)})`,
		row: (e) => e.m[t]
	}));
	let p = f.map((t) => ({
		sum: t,
		el: i("p", e, { class: "equation" })
	}));
	return { update() {
		for (let { sum: e, el: t } of p) {
			let r = a.map((t) => n.here[e.row(t)] / e.unit.size), i = Math.max(...r.map(Math.abs), 0), s = r.map((e, t) => ({
				v: e,
				k: t
			})).filter((e) => Math.abs(e.v) > 1e-9 * i);
			if (!n.solved || !s.length) {
				t.textContent = `${e.head}: ${n.solved ? "nothing acts" : "no answer here"}`;
				continue;
			}
			let c = s.map((t) => e.sign(a[t.k])).join(" + "), l = s.reduce((e, t) => e + t.v, 0), u = s.map((e, t) => (e.v < 0 ? t ? " − " : "−" : t ? " + " : "") + o(Math.abs(e.v))).join("");
			t.textContent = `${e.head}: ${c} = ${u} = ${o(Math.abs(l) < 1e-9 * i ? 0 : l)} ${e.unit.unit}`;
		}
	} };
}
function pn(e, t) {
	i("p", e, {}, "One linear system per position gives forces and motion (D'Alembert's principle); everything shown is recomputed from the numbers beside it, in double precision.");
	let n = i("dl", e);
	for (let [e, r] of Object.entries(t.assumptions)) i("dt", n, {}, e), i("dd", n, {}, r);
	t.source && i("p", e, {}, `Source: ${t.source}`), i("p", e, {}, `Made with dalembert ${t.version}.`);
}
// src/charts.ts
var mn = 16, hn = 5, gn = 8, _n = 4;
function vn(e, t) {
	let n = e / t || 1, r = 10 ** Math.floor(Math.log10(n));
	return r * ([
		1,
		2,
		5,
		10
	].find((e) => e * r >= n) ?? 10);
}
function yn(e, t) {
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
	].find((n) => n >= e / t) ?? 360 * vn(e / 360, t);
}
function bn(e, t, n) {
	let r = Math.ceil(e / n - 1e-9), i = Math.floor(t / n + 1e-9) - r + 1;
	return Array.from({ length: Math.max(i, 0) }, (e, t) => (r + t) * n);
}
function xn(t, s, c, d, f, p) {
	let h = i("figure", t, { class: "chart" }), g = s.units[d.kind];
	i("figcaption", h, {}, `${d.title}, ${g.unit}`);
	let _ = s.views.charts.flatMap((e) => e.curves.map((e) => m(e.name, 3))), v = Math.max(44, 13 + _n * d.curves.length), y = ut(h, p, v, d.title), b = v - hn - gn, x = -v / 2 + hn, S = 0, C = 0, w = r("path", y, {
		class: "l-grid",
		style: "fill:none"
	}), T = r("path", y, {
		class: "l-axis",
		style: "fill:none"
	}), E = r("g", y), D = d.curves.map((e) => r("path", y, {
		class: `l-${e.role}`,
		style: "fill:none"
	})), O = r("path", y, { class: "cursor" }), k = d.curves.map((e) => r("circle", y, {
		class: `l-${e.role}-h`,
		r: .9
	})), A = Math.max(c.count - 1, 1), j = s.noise[d.kind] ?? 0, M = d.curves.map((e, t) => {
		let n = r("text", y, {
			class: `l-${e.role}-t key`,
			"font-size": 3,
			y: x + 3 + _n * t,
			tabindex: 0,
			role: "button"
		});
		return u(n, e.name, 3), r("title", n).textContent = "show what lowers its peak", n.addEventListener("click", () => f.pick(e)), n.addEventListener("keydown", (t) => t.key === "Enter" && f.pick(e)), n;
	}), N = (e, t) => {
		let n = c.value(e.row, t) / g.size;
		return Math.abs(n) * g.size < j ? 0 : n;
	}, P = NaN, F = NaN, I = 1, L = !0, R = (e) => C + e / A * S, z = (e) => x + b - (e - P) / (F - P) * b;
	function* B() {
		let [e, t] = [Infinity, -Infinity];
		for (let n of d.curves) {
			for (let r = 0; r < c.count; r++) if (c.good[r]) {
				let i = N(n, r), a = c.reverses(r) ? c.onceAfter(() => N(n, r)) : i;
				e = Math.min(e, i, a), t = Math.max(t, i, a);
			}
			yield;
		}
		return e <= t || ([e, t] = [0, 1]), e > 0 && e < .4 * t && (e = 0), t < 0 && t > .4 * e && (t = 0), t - e < 1e-9 * Math.max(Math.abs(t), Math.abs(e), 1e-9) && ([e, t] = [Math.min(e, 0), Math.max(t, 0) || 1]), I = vn(t - e, 4), [e, t] = [Math.floor(e / I + 1e-9) * I, Math.ceil(t / I - 1e-9) * I], e === P && t === F && !L ? !1 : ([P, F, L] = [
			e,
			t,
			!1
		], !0);
	}
	function V() {
		let t = s.drives[0], n = (e, t, n, i) => r("text", E, {
			class: "l-note-t",
			"font-size": 2.6,
			"text-anchor": i,
			x: t,
			y: n
		}).textContent = e;
		E.replaceChildren();
		let i = "";
		for (let e of bn(P, F, I)) i += `M${C} ${a(z(e))}h${S}`, n(o(e, 5), C - 1.2, z(e) + .9, "end");
		if (t) {
			let [e, r] = [0, A].map((e) => c.position(t.name, e) / t.size);
			for (let s of bn(Math.min(e, r), Math.max(e, r), (t.unit === "°" ? yn : vn)(Math.abs(r - e), 6))) {
				let c = C + (s - e) / (r - e || 1) * S;
				i += `M${a(c)} ${x}v${b}`, n(o(s, 5) + (t.unit === "°" ? "°" : ""), c, x + b + 3.4, "middle");
			}
			n(`${t.name}, ${t.unit}`, C + S, x + b + 6.6, "end");
		}
		e(w, "d", i), e(T, "d", `M${C} ${x}v${b}` + (P < 0 && F > 0 ? `M${C} ${a(z(0))}h${S}` : ""));
	}
	function H(e) {
		p = e, [S, C] = [p - mn - Math.min(Math.max(..._) + 4, .3 * p), -p / 2 + mn], y.setAttribute("viewBox", `${-p / 2} ${-v / 2} ${p} ${v}`), M.forEach((e) => e.setAttribute("x", a(C + S + 2))), L = !0;
	}
	H(p);
	let U = (e) => f.seek((l(y, e)[0] - C) / S * A);
	y.addEventListener("pointerdown", (e) => {
		e.target.closest(".key") || (y.setPointerCapture(e.pointerId), U(e));
	}), y.addEventListener("pointermove", (e) => e.buttons && y.hasPointerCapture(e.pointerId) && U(e));
	function* W() {
		(yield* B()) && V();
		for (let [t, n] of D.entries()) yield, e(n, "d", je(c, (e) => [R(e), z(N(d.curves[t], e))]));
	}
	return {
		figure: h,
		resize: H,
		parts: W,
		update(t) {
			t && Ge(W());
			let r = a(R(Math.min(f.time(), A)));
			e(O, "d", `M${r} ${x}v${b}`), d.curves.forEach((e, t) => {
				let i = c.solved ? z(c.here[e.row] / g.size) : NaN, o = Number.isFinite(i);
				n(k[t], {
					visibility: o ? "visible" : "hidden",
					...o && {
						cx: r,
						cy: a(i)
					}
				}), M[t].classList.toggle("picked", f.picked() === e);
			});
		}
	};
}
var Sn = (e, { f: t }) => e.largest((n) => Math.hypot(e.value(t[0], n), e.value(t[1], n)));
function Cn(e, t) {
	let n = -1, r = 0;
	return () => (n !== e.cycles && ([n, r] = [e.cycles, Math.max(...t.map((t) => Sn(e, t)))]), r);
}
var wn = 1e-11;
function Tn(a, s, c, l, u) {
	let d = i("figure", a, { class: "polar" }), [f, p] = c.f, m = i("figcaption", d), h = ut(d, 66, 66, `polar diagram of joint ${c.name}`);
	r("path", h, {
		class: "l-grid",
		style: "fill:none",
		d: "M-30 0H30M0 -30V30M15 0A15 15 0 1 0 -15 0A15 15 0 1 0 15 0M30 0A30 30 0 1 0 -30 0A30 30 0 1 0 30 0"
	});
	let _ = r("path", h, {
		class: `l-${c.role}`,
		style: "fill:none"
	}), v = new g(h, "joint-force", c.name), y = 1, b = !1;
	function* x() {
		let r = l();
		yield;
		let i = Sn(s, c);
		b = !(i > wn * r), n(h, { display: b ? "none" : "inline" });
		let a = tt(i / u.size), d = `Joint ${c.name}: ${b ? "no force at any position" : `circles of ${o(a / 2)} and ${o(a)} ${u.unit}`}`;
		t(m, d), b || (y = a / 30 * u.size, e(_, "d", je(s, (e) => [s.value(f, e) / y, -s.value(p, e) / y], !0)));
	}
	return {
		figure: d,
		parts: x,
		update(e) {
			e && Ge(x()), v.set([0, 0], s.solved && !b ? [s.here[f] / y, -s.here[p] / y] : [0, 0]);
		}
	};
}
function En(n, a, o, c, l) {
	let u = i("figure", n, { class: "polygon" }), d = a.units.force, f = i("figcaption", u, {}, c), p = ut(u, 110, 80, c), m = r("g", p), h = /* @__PURE__ */ new Set(), _ = l.map(({ sides: e }) => {
		let t = e.find((e) => e.kind === "joint" && h.has(e.of));
		for (let t of e) t.kind === "joint" && h.add(t.of);
		return {
			shared: t,
			drawn: e.filter((e) => e !== t).map((e) => ({
				s: e,
				arrow: new g(p, e.role, e.name),
				name: he(m, e.role, e.name, 3)
			}))
		};
	}), v = r("path", p, {
		class: "l-gap",
		style: "fill:none"
	}), y = new lt(p, !0);
	return {
		figure: u,
		update() {
			if (e(p, "visibility", o.solved ? "visible" : "hidden"), !o.solved) return;
			let n = o.here, r = /* @__PURE__ */ new Map(), i = [], l = [], u = _.flatMap(({ shared: e, drawn: t }) => {
				let a = rt(i)?.y[1] ?? 0, o = r.get(e?.of ?? "") ?? [0, a], s = (e) => [o[0] + n[e[0]], o[1] - n[e[1]]], c = o;
				e && (o = s(e.f));
				let u = t.map((e) => {
					let t = o;
					return o = s(e.s.f), e.s.kind === "joint" && !r.has(e.s.of) && r.set(e.s.of, o), i.push(t, o), {
						...e,
						from: t,
						to: o
					};
				});
				return l.push([c, o]), u;
			}), m = rt(i) ?? {
				x: [0, 0],
				y: [0, 0]
			}, h = !(Math.max(m.x[1] - m.x[0], m.y[1] - m.y[0]) > 1e3 * a.noise.force);
			if (t(f, h ? `${c}: no forces` : c), p.toggleAttribute("hidden", h), h) return;
			let g = tt(Math.max((m.x[1] - m.x[0]) / 66, (m.y[1] - m.y[0]) / 48) / d.size) * d.size, b = ([e, t]) => [(e - (m.x[0] + m.x[1]) / 2) / g, (t - (m.y[0] + m.y[1]) / 2) / g], x = new _e([
				-55,
				-40,
				55,
				36
			]);
			for (let { from: e, to: t } of u) x.line(b(e), b(t));
			for (let { arrow: t, name: n, from: r, to: i } of u) {
				let [a, o] = [b(r), b(i)], s = t.set(a, o), c = [(a[0] + o[0]) / 2, (a[1] + o[1]) / 2];
				e(n.el, "visibility", s ? "visible" : "hidden"), s && x.put({
					label: n,
					anchors: [c],
					away: c,
					leave: .9
				});
			}
			e(v, "d", l.map(([e, t]) => s([b(e), b(t)])).join("")), y.set([-53, 37.4], g, d);
		}
	};
}
// src/results.ts
var Dn = 4.6, On = (e) => Math.min(Math.max(e / Dn, 72), 140), kn = (e) => !e.closest("[role=tabpanel]")?.hidden && (e.closest("details")?.open ?? !0);
function An(e, t, n, r, a, o) {
	let { charts: s, bodies: c, polygons: l } = t.views, u = [], d = [], f = [], p = /* @__PURE__ */ new Set(), m = new IntersectionObserver((e) => e.forEach((e) => e.isIntersecting ? p.add(e.target) : p.delete(e.target)));
	function h(e) {
		return f.push(e), m.observe(e.figure), e;
	}
	let g = n.count > 1 ? e.add("Curves", "forces and efforts over the cycle") : null;
	for (let e of g ? s : []) u.push(h(xn(g, t, n, e, r, 120)));
	let _ = n.count > 2 ? s.flatMap((e) => e.curves).filter((e) => e.f) : [];
	if (g && _.length) {
		i("h2", g, {}, "Polar diagrams");
		let e = Cn(n, [..._, ...t.views.mechanism.arrows.filter((e) => e.t === "force")]);
		for (let r of _) d.push({
			box: g,
			view: h(Tn(g, n, r, e, t.units.force))
		});
	}
	let v = e.add("Forces", "free bodies, their equations, and force polygons"), y = i("select", v, { "aria-label": "link" }), b = c.map((e, r) => {
		i("option", y, { value: r }, `${e.title}${e.member && `, ${e.member} member`}`);
		let o = i("div", v, { class: "body" }), s = pt(o, n, e, e.about, 110, 100, t.units, `free body of ${e.title}`, a);
		return d.push({
			box: o,
			view: s,
			link: r
		}, {
			box: o,
			view: fn(o, t, n, e),
			link: r
		}), s;
	});
	if (l.links.length) {
		l.links.forEach((e, r) => {
			let i = En(v, t, n, `Force polygon of link ${e.title}`, [e]);
			d.push({
				box: i.figure,
				view: i,
				link: r
			});
		});
		let e = l.chain.map((e) => l.links[e]);
		d.push({
			box: v,
			view: En(v, t, n, `In the order of solution: ${e.map((e) => e.title).join(" → ")}`, e)
		});
	}
	let x = e.add("Numbers", "the numbers of this position");
	d.push({
		box: x,
		view: dn(x, t, n)
	});
	let S = () => void (a.body = c[+y.value]?.link ?? ""), C = (e) => {
		let t = c.findIndex((t) => t.link === e);
		return t >= 0 && (y.value = String(t)), S(), t >= 0;
	};
	y.addEventListener("change", () => (S(), o())), C(a.body);
	function w() {
		for (let e of b) e.fit();
		let e = Math.max(0, ...b.map((e) => e.need()));
		for (let t of b) t.fit(e || void 0);
	}
	return {
		bodies: b,
		fit: w,
		choose: C,
		*parts() {
			for (let e of f) p.has(e.figure) && (yield* e.parts());
		},
		resize: (e) => u.forEach((t) => t.resize(On(e))),
		update(e) {
			for (let t of u) kn(g) && t.update(e);
			for (let { box: t, view: n, link: r } of d) r !== void 0 && (t.hidden = r !== +y.value), (r === void 0 || r === +y.value) && kn(t) && n.update(e);
		}
	};
}
// src/sentences.ts
function jn(e, t = 6) {
	if (!Number.isFinite(e)) return Number.isNaN(e) ? "nan" : e > 0 ? "inf" : "-inf";
	let [n, r] = e.toExponential(t - 1).split("e"), i = +r, a = (e) => e.includes(".") ? e.replace(/\.?0+$/, "") : e;
	return i < -4 || i >= t ? `${a(n)}e${i < 0 ? "-" : "+"}${String(Math.abs(i)).padStart(2, "0")}` : a(e.toFixed(Math.max(t - 1 - i, 0)));
}
var Mn = (e) => e.length < 2 ? e.join("") : `${e.slice(0, -1).join(", ")} and ${e.at(-1)}`, Nn = class {
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
				found: jn(r),
				ri: jn(Math.abs(i)),
				rj: jn(Math.abs(a)),
				wanted: jn(o)
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
		})), d = l.length === 1 ? "reverses" : "reverse", f = l.length === 1 ? "its" : "their";
		return {
			...i,
			joints: e === "reversal" ? Mn(l) : l.join(", "),
			verb: d,
			whose: f,
			values: Mn(u),
			name: s[0] ?? "",
			intervals: this.intervals()
		};
	}
	intervals() {
		let e = (e) => this.s.unknowns.filter((t) => !!t.single === e).map((e) => e.name), t = e(!1), n = e(!0);
		return [...t.length ? [`${Mn(t)} ${t.length === 1 ? "lies" : "each lie"} in an interval`] : [], ...n.length ? [`${Mn(n)} ${n.length === 1 ? "does" : "do"} not depend on it`] : []].join("; ");
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
		return `${jn(e / i, n)} ${r}`;
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
		let a = r.joints.slice(0, 6).map((e) => `${e.joint} (${e.angular ? "turn" : "slide"})`), o = a.length ? ` at ${i === 1 ? "one" : "some"} of ${a.join(", ")}` : "", s = (e, t, n = `${t}s`) => e ? `${e} ${e > 1 ? n : t}` : `no ${t}`;
		return `${Q(this.s.words.counts, {
			freedoms: s(r.freedoms, "degree of freedom", "degrees of freedom"),
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
}, Pn = 0;
function Fn(e, t, n) {
	let r = i("div", e, {
		class: "tabs",
		role: "tablist",
		"aria-label": "results"
	}), a = i("div", e, { class: "panels" }), o = [], s = (e, t = !1) => {
		let n = o.find((t) => t.name === e) ?? o[0];
		if (n) {
			for (let { tab: e, panel: t } of o) {
				let r = t === n.panel;
				e.setAttribute("aria-selected", String(r)), e.tabIndex = r ? 0 : -1, t.hidden = !r;
			}
			t && n.tab.focus(), a.scrollTop = 0;
		}
	}, c = (e, r = !1) => {
		t.tab = e === o[0].name ? "" : e, s(e, r), n();
	};
	return r.addEventListener("keydown", (e) => {
		let t = o.findIndex((t) => t.tab === document.activeElement || t.tab === e.target), n = o.length, r = {
			ArrowRight: (t + 1) % n,
			ArrowLeft: (t + n - 1) % n,
			Home: 0,
			End: n - 1
		}[e.key];
		t < 0 || r === void 0 || (e.preventDefault(), e.stopPropagation(), c(o[r].name, !0));
	}), {
		add(e, n = e) {
			let l = `dalembert-tab-${++Pn}`, u = i("button", r, {
				type: "button",
				role: "tab",
				id: l,
				title: n,
				"aria-controls": `${l}-panel`
			}, e), d = i("section", a, {
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
function In(e, n, r, a, o, s) {
	let c = i("header", e);
	i("h1", c, {}, n.title);
	let l = i("div", c, {
		class: "bar",
		role: "toolbar",
		"aria-label": "cycle and page"
	}), u = (e, t, n) => {
		let r = i("button", l, {
			type: "button",
			title: t,
			.../^\w/.test(e) ? {} : { "aria-label": t }
		}, e);
		return r.addEventListener("click", n), r;
	}, d = u("▶", "play along the cycle (space)", s.play), f = i("input", l, {
		type: "range",
		min: 0,
		max: r.end,
		step: n.only_at_positions ? 1 : "any",
		"aria-label": "position in the cycle"
	}), p = i("output", l, { class: "readout" }), m = i("select", l, {
		class: "speed",
		title: "speed of play; , and . step, with Shift by ten",
		"aria-label": "speed of play"
	});
	for (let e of Je) i("option", m, { value: e }, `${e}×`);
	m.value = String(o.speed), m.addEventListener("change", () => o.speed = +m.value);
	let h = u("↶", "undo (Ctrl+Z)", () => s.go(!0)), g = u("↷", "redo (Ctrl+Y)", () => s.go(!1));
	s.back && u("Back", "back to the sketch: undo the last addition", s.back), u("Reset", "all numbers as in the file", s.reset);
	let _ = i("p", c, {
		class: "mark",
		role: "status"
	});
	f.addEventListener("input", () => s.show(+f.value));
	for (let e of [
		d,
		f,
		p,
		m
	]) e.hidden = r.count < 2;
	return {
		playing: (e) => d.textContent = e ? "❚❚" : "▶",
		update(e, i, o) {
			let s = [o, a.at(e)].filter(Boolean).join(" ");
			t(_, s), f.value = String(e), t(p, kt(n, r, e)), [h.disabled, g.disabled] = i.map((e) => !e);
		}
	};
}
// src/tracers.ts
function Ln(t, i, o, s) {
	let c = r("g", null, { class: "tracers" });
	t.svg.querySelector("g").before(c);
	let l = [], u = () => s.tracers.filter((e) => i.links.includes(e.link)), d = (e) => je(o, (n) => i.on(t.paper, i.links.indexOf(e.link), e.u, n), !0);
	function* f() {
		for (let [t, n] of u().entries()) l[t] && e(l[t].line, "d", d(n)), yield;
	}
	function p(o) {
		let s = u();
		for (; l.length > s.length;) for (let e of Object.values(l.pop())) e.remove();
		s.forEach((s, u) => {
			let f = i.links.indexOf(s.link), p = !l[u];
			l[u] ??= {
				line: r("path", c, {
					class: "l-trace",
					style: "fill:none"
				}),
				dot: r("circle", c, {
					class: "l-trace tracer",
					r: 1.1,
					"data-item": `tracer:${u}`
				})
			}, (o || p) && e(l[u].line, "d", d(s));
			let [m, h] = t.paper.of(...t.paper.project(i.place(f, s.u)));
			n(l[u].dot, {
				cx: a(m),
				cy: a(h)
			});
		});
	}
	return {
		update: p,
		parts: f
	};
}
// src/solved.ts
var Rn = "input:not([type=range],[type=checkbox]),textarea,[contenteditable]", zn = "button,summary,select,a,input[type=checkbox],[role=button],[role=tab]", Bn = 6, Vn = 10, Hn = 1, Un = 8, Wn = 4;
async function Gn(e, n, r, a) {
	let s = await sn.create(n), c = [], l = new Xt(n, s);
	a.changes && l.change(a.changes), a.address && Pt(s, l, r, location.hash);
	let u = a.pose && s.motion.take(a.pose);
	u != null && (r.t = u), r.t = Math.min(Math.max(Number.isFinite(r.t) && !a.anew ? r.t : n.start, 0), s.end);
	let f = 0, p = !0, m = 0, h = !1, g = !1, _ = null;
	s.cycle();
	let b = new jt(s, l), x = n.views.charts.flatMap((e) => e.curves.map((t) => ({
		curve: t,
		unit: n.units[e.kind]
	}))), S = x.find((e) => e.curve.of === r.curve) ?? x.find((e) => n.gradient?.curves.includes(e.curve.row)) ?? x[0], C = new Nn(n, s), w = In(e, n, s, C, r, {
		play: J,
		show: q,
		go: ue,
		reset: le,
		back: a.back
	}), T = i("main", e), E = i("section", T, {
		class: "stage",
		"aria-label": "mechanism"
	}), D = new y(n.sketch.links, n.sketch.poses, s), O = Ct(E, s, n.views.mechanism, n.units, r, {
		full: a.full,
		rates: n.views.rates,
		on: a.on,
		entries: ee,
		chosen: te,
		again: Y,
		held: (e) => s.count > 1 && ie(n, `${e.kind}:${e.name}`) >= 0
	}), { m: k, paper: A } = O, j = i("output", A, {
		class: "digits",
		"aria-label": "value of the chosen curve"
	}), M = new Ot(k, n, s), N = Ln(k, D, s, r), P = new At(A, k, n, s, n.handles.flatMap((e) => e.kind === "joint" || e.kind === "point" ? [e.p] : [])), F = Zt(k, n, s, {
		changed: se,
		finished: ce
	});
	oe(k, n, s, D, {
		seek: q,
		time: () => r.t
	});
	let I = v(k, n, s), L = i("section", T, {
		class: "side",
		"aria-label": "results"
	}), R = Fn(L, r, () => Y(!0)), z = (e) => (S = x.find((t) => t.curve === e), r.curve = e.of, Y(!0)), B = An(R, n, s, {
		time: () => r.t,
		seek: q,
		pick: z,
		picked: () => S?.curve
	}, r, () => Y(!0)), V = U(), H = cn(R.add("Change", "every number of the file"), n, s, l, (e) => e ? ce() : se());
	ne(), pn(R.add("About", "method and assumptions"), n);
	function U() {
		let e = i("div", E, { class: "switches" }), { arrows: t, labels: a } = n.views.mechanism;
		Dt(e, O.view, r, s.count > 1, () => Y(!0));
		let o = (e) => t.some((t) => e.includes(t.kind)), c = n.views.rates.length > 0, l = [
			["values", !0],
			["digits", x.length > 0],
			["loads", o([
				"load",
				"effort",
				"weight",
				"spring",
				"damper"
			])],
			["reactions", o(["joint", "friction"])],
			["inertia", o(["inertia"])],
			["velocities", c],
			["accelerations", c],
			["names", !0],
			["traces", n.views.mechanism.items.some((e) => e.t === "trace")]
		];
		return n.gradient && Tt(e, {
			said: "what lowers the peak",
			title: "arrows: moving a joint in this direction lowers the peak of the chosen curve",
			on: !1,
			act: (e) => (M.on = e, Y(!0))
		}), Et(e, r, l.flatMap(([e, t]) => t ? [e] : []), a.filter((e) => e.kind === "joint").length > Un, () => (re(), Y(!0))), n.handles.some((e) => e.kind === "joint") && Tt(e, {
			said: "tolerances",
			title: "a thousand machines with points displaced by up to 0.5 % of the drawing's width",
			on: !1,
			act: (e) => (P.on = e, Y(!0))
		}), k.paper.axes.length > 2 && i("span", e, {}, "drag to rotate the view"), i("span", e, { class: "spread" });
	}
	function W({ kind: e, name: t }) {
		return n.sketch.links[ie(n, `${e}:${t}`)] ?? n.views.mechanism.arrows.find((n) => n.of === t && n.kind === e)?.link;
	}
	function G({ kind: e, name: t }) {
		let r = n.handles.find((n) => n.kind === e && (n.name === t || n.name.startsWith(`${t}:`)));
		return r ? k.paper.point(r.p) : null;
	}
	function ee(e, t) {
		let i = [], a = /* @__PURE__ */ new Set();
		for (let o of e.slice(0, Wn)) {
			let { kind: e, name: c } = o, l = ie(n, `${e}:${c}`), u = l < 0 ? void 0 : n.sketch.links[l], f = e === "joint" || e === "reaction" ? x.find((e) => e.curve.of === `reaction.${c}.magnitude`) : x.find((t) => t.curve.of.startsWith(`${e}.${c}.`));
			f && i.push({
				said: `Curve of ${d(f.curve.name)}`,
				act: () => (z(f.curve), R.show("Curves"))
			});
			let p = n.numbers.find((t) => t.path.split(".")[1] === c && t.path.startsWith(e === "center" ? "link" : e));
			p && i.push({
				said: `Numbers of ${c}`,
				act: () => (R.show("Change"), H.focus(p.path))
			}), e === "tracer" && i.push({
				said: "Remove this path",
				act: () => (r.tracers.splice(+c, 1), re(), Y(!0))
			}), u && !a.has(u) && (a.add(u), i.push({
				said: `Free body of ${u}`,
				act: () => (B.choose(u), R.show("Forces"))
			}), s.count > 1 && i.push({
				said: `Path of this point of ${u}`,
				act: () => {
					r.tracers.push({
						link: u,
						u: D.local(k.paper, l, G(o) ?? k.paper.of(...t))
					}), re(), Y(!0);
				}
			}));
		}
		return r.window && i.push({
			said: "Fit the whole mechanism",
			act: O.view.fit
		}), i.filter((e, t) => i.findIndex((t) => t.said === e.said) === t);
	}
	function te(e) {
		e && e.kind !== "joint" && B.choose(W(e)), Y(!0);
	}
	function ne() {
		let e = R.add("Save", "files to save, print, share"), t = Bt(n.title), o = (t, n) => i("button", e, { type: "button" }, t).addEventListener("click", n);
		n.template.length && o("Model file", () => X(`${t}.yaml`, Ft(n, s), "text/yaml")), o("Curves as CSV", () => X(`${t}.csv`, It(n, s), "text/csv")), o("Drawing as SVG", () => X(`${t}.svg`, Lt(k.svg, n.style.light), "image/svg+xml")), o("Drawing as PNG", () => void zt(k.svg, n.style.light).then((e) => X(`${t}.png`, e, "image/png"))), o("Print", () => window.print()), a.address && o("Copy link", () => {
			location.hash = Nt(n, s, r), navigator.clipboard?.writeText(location.href);
		});
	}
	function re() {
		a.address && window.history.replaceState(null, "", "#" + Nt(n, s, r)), a.on?.({
			type: "view",
			view: r
		});
	}
	function ae() {
		Y(!0), H.update();
		let e = Mt(n, s);
		a.edited?.(e), a.on?.({
			type: "change",
			changes: e
		}), re();
	}
	function se() {
		s.coarse = !0, l.pass(), Y(!0);
	}
	function ce() {
		s.coarse = !1;
		let { sentence: e } = l;
		l.pass() && (l.sentence = e), b.note(), K(!0), ae();
	}
	function le() {
		l.change({}), ce(), K();
	}
	function ue(e) {
		b.go(e) && (K(!0), ae());
	}
	function K(e = !1) {
		s.cycle(), k.fit(void 0, e), B.fit();
	}
	function de() {
		O.resize();
		let e = L.querySelector(".panels").clientWidth;
		e > 0 && B.resize(e - 12), k.fit(), Y(!0);
	}
	function q(e) {
		r.t = Math.min(Math.max(e, 0), s.end), n.only_at_positions && (r.t = Math.round(r.t)), Y(!1);
	}
	function fe(e) {
		let t = e > 0 ? Math.floor(r.t + 1e-9) + e : Math.ceil(r.t - 1e-9) + e;
		q(s.cyclic ? (t % s.count + s.count) % s.count : t);
	}
	function J() {
		if (w.playing(!m), m) return pe();
		let e = performance.now(), t = r.t, n = (i) => {
			t += (i - e) / 1e3 / Bn * r.speed * s.end, e = i, t >= s.end && (t = 0), q(t), m = requestAnimationFrame(n);
		};
		m = requestAnimationFrame(n);
	}
	function pe() {
		cancelAnimationFrame(m), m = 0;
	}
	function Y(e) {
		p ||= e, g || (f ||= requestAnimationFrame(() => {
			f = 0;
			let e = performance.now();
			me(), c.push(performance.now() - e), c.length > 2e3 && c.shift();
		}));
	}
	function me() {
		let n = s.coarse && !M.on, i = p && !n;
		h = p && n || h && !i, i && (_ = null, s.cycle()), p = !1, s.at(r.t);
		let a = C.refusal();
		a !== s.refused && (s.refused = a, s.cycle()), e.classList.toggle("unsolved", !s.solved), e.classList.toggle("turning", r.drag === "turn"), k.update(i), N.update(i), F(), I(), M.update(S?.curve);
		let c = P.update(S?.curve.row), u = M.on && S && M.peak(S.curve), f = u && S ? `arrows lower the peak of ${d(S.curve.name)}, now ${o(u.size / S.unit.size)} ${S.unit.unit}${u.where}` : "";
		t(V, [f, c && S ? `${d(S.curve.name)}: ${o(c.mean / S.unit.size)} ± ${o(c.sigma / S.unit.size, 2)} ${S.unit.unit} (1 σ)` : ""].filter(Boolean).join("; ")), j.hidden = !S || !k.on("digits"), S && !j.hidden && t(j, `${d(S.curve.name)} ${s.solved ? o(s.here[S.curve.row] / S.unit.size) : "–"} ${S.unit.unit}`), B.update(i), w.update(r.t, b.can, l.sentence), n && ge();
	}
	function* he() {
		yield* s.parts(), yield* k.parts(), yield* N.parts(), yield* B.parts();
	}
	function ge() {
		let e = performance.now() + Hn;
		do {
			if (!_ && !h) return;
			_ || ([_, h] = [he(), !1]), _.next().done && (_ = null);
		} while (performance.now() < e);
		Y(!1);
	}
	e.querySelectorAll("details").forEach((e) => e.addEventListener("toggle", () => Y(!0)));
	let _e = a.full ? document : e, ve = (e) => ye(e);
	_e.addEventListener("keydown", ve);
	function ye(e) {
		let t = e.target;
		if (!(e.defaultPrevented || t.closest?.(Rn))) {
			if ((e.ctrlKey || e.metaKey) && !e.altKey && /^[zy]$/i.test(e.key)) e.preventDefault(), ue(e.key.toLowerCase() === "z" && !e.shiftKey);
			else if (e.ctrlKey || e.metaKey || e.altKey || s.count < 2) return;
			else e.key === " " && !t.closest?.(zn) ? (e.preventDefault(), J()) : ".,><:;".includes(e.key) && fe((".>:".includes(e.key) ? 1 : -1) * (".,".includes(e.key) ? 1 : Vn));
		}
	}
	return s.at(r.t), K(), {
		kernel: s,
		data: n,
		times: c,
		show: q,
		stage: O,
		opened() {
			de(), me(), H.update(), O.choose(r.chosen);
		},
		set(e) {
			l.change(e), b.note(), K(!0), Y(!0), H.update();
		},
		text: () => Ft(n, s),
		pose: () => s.motion.placed(),
		redraw: () => Y(!0),
		observed: [A, L],
		resize: de,
		remove() {
			pe(), g = !0, cancelAnimationFrame(f), _e.removeEventListener("keydown", ve);
		}
	};
}
// src/page.ts
async function Kn(e, t, n = {}) {
	let r = n.view ?? Ye(), a = new ResizeObserver(() => s.resize()), o = [], s = await c(t, n);
	async function c(t, s) {
		let c = document.createElement("div");
		c.className = n.full ? "dalembert full" : "dalembert", c.tabIndex = -1;
		let f = `@media (prefers-color-scheme:dark){${t.style.dark}}@media print{${t.style.light}}`;
		i("style", c).textContent = ".dalembert{--ink:#1d2733;--grey:#5b6672;--paper:#fff;--soft:#f4f6f8;--rim:#d5dbe1;--warn:#b3261e;--accent:#1c56a8;color:var(--ink);background:var(--paper);outline:none;font:15px/1.45 system-ui,DejaVu Sans,sans-serif;container-type:inline-size}.dalembert.full{height:100vh;flex-direction:column;height:100dvh;display:flex;overflow:hidden}.dalembert *{box-sizing:border-box}.dalembert [hidden]{display:none!important}.dalembert header{z-index:2;background:var(--paper);border-bottom:1px solid var(--rim);padding:.3em .8em;position:sticky;top:0}.dalembert h1{text-overflow:ellipsis;white-space:nowrap;margin:0;font-size:1.1em;overflow:hidden}.dalembert .bar{align-items:center;gap:.5em;margin-top:.15em;display:flex}.dalembert .bar input{min-width:4em;accent-color:var(--accent);flex:1}.dalembert .readout{white-space:nowrap;font-variant-numeric:tabular-nums;min-width:8em}.dalembert button{font:inherit;color:inherit;background:var(--soft);border:1px solid var(--rim);cursor:pointer;border-radius:.4em;padding:.15em .6em}.dalembert button:disabled{opacity:.4;cursor:default}.dalembert .mark{color:var(--warn);background:var(--paper);margin:0;padding:.2em .9em;font-size:.92em;position:absolute;top:calc(100% + 1px);left:0;right:calc(clamp(22rem,36cqw,42rem) + 1.6em)}.dalembert .mark:empty{display:none}.dalembert main{grid-template-columns:minmax(0,1fr) clamp(22rem,36cqw,42rem);align-items:start;gap:.8em;padding:.6em .8em;display:grid}.dalembert.full main{flex:1;align-items:stretch;min-height:0;padding-bottom:0}.dalembert .stage{-webkit-user-select:none;user-select:none;flex-direction:column;min-width:0;display:flex;position:sticky;top:5em}.dalembert.full .stage{min-height:0;position:static}.dalembert .paper{aspect-ratio:10/7;min-height:14em;max-height:calc(100vh - 9em);position:relative}.dalembert.full .paper{aspect-ratio:auto;flex:1;min-height:0;max-height:none}.dalembert .side{min-width:0}.dalembert.full .side{flex-direction:column;min-height:0;display:flex}.dalembert .tabs{border-bottom:1px solid var(--rim);flex-wrap:wrap;gap:.15em;display:flex}.dalembert .tabs button{background:0 0;border:0;border-bottom:2px solid #0000;border-radius:0;padding:.2em .55em}.dalembert .tabs button[aria-selected=true]{border-color:var(--accent);font-weight:600}.dalembert .panels{outline:none;padding:.4em .4em 1em 0}.dalembert.full .panels{flex:1;min-height:0;overflow-y:auto}.dalembert h2{margin:.6em 0 .2em;font-size:.95em}.dalembert .group{display:inline-flex}.dalembert .group button{border-radius:0;min-width:2em;font-size:1em}.dalembert .group button+button{border-left:0}.dalembert .group button:first-child{border-radius:.4em 0 0 .4em}.dalembert .group button:last-child{border-radius:0 .4em .4em 0}.dalembert button[aria-pressed=true]{background:var(--accent);color:var(--paper);border-color:var(--accent)}.dalembert .digits{pointer-events:none;font-variant-numeric:tabular-nums;text-shadow:0 0 .2em var(--paper),0 0 .2em var(--paper);font-size:clamp(1.8rem,5cqw,4rem);font-weight:700;position:absolute;top:.1em;left:.25em}.dalembert main.one{flex-direction:column;display:flex}.dalembert main.one .stage{flex:1}.dalembert.full main.one .paper{aspect-ratio:auto;min-height:20em;max-height:none}.dalembert .missing{flex-wrap:wrap;gap:.3em;padding:.1em 0 .4em;display:flex}.dalembert .missing p{color:var(--warn);flex-basis:100%;margin:0;font-size:.92em}.dalembert .menu{z-index:9;background:var(--paper);border:1px solid var(--rim);border-radius:.4em;flex-direction:column;min-width:11em;max-width:min(22em,100vw - 8px);max-height:calc(100vh - 8px);padding:.25em;display:flex;position:fixed;overflow-y:auto;box-shadow:0 .3em 1.2em #00000040}.dalembert .menu button{text-align:left;background:0 0;border:0;border-radius:.3em;padding:.35em .6em}.dalembert .menu button:hover,.dalembert .menu button:focus{background:var(--soft);outline:none}.dalembert .chosen{filter:drop-shadow(0 0 .5px var(--accent)) drop-shadow(0 0 1px var(--accent))}.dalembert.turning .handles{display:none}.dalembert .tracer{fill:currentColor;color:var(--accent);cursor:pointer}.dalembert .paper svg:focus-visible{outline:2px solid var(--accent);outline-offset:-2px}.dalembert svg{touch-action:pan-y;-webkit-user-select:none;user-select:none;width:100%;height:auto;font-family:DejaVu Sans,Helvetica Neue,Arial,sans-serif;display:block;overflow:hidden}.dalembert .paper svg{touch-action:none;outline:none;height:100%;position:absolute;inset:0}.dalembert .cloud{pointer-events:none;width:100%;height:100%;position:absolute;top:0;left:0}.dalembert .switches{color:var(--grey);flex-wrap:wrap;align-items:center;gap:.2em .8em;padding:.3em 0;font-size:.88em;display:flex}.dalembert .switches label{cursor:pointer;align-items:center;gap:.3em;display:flex}.dalembert figure{margin:0 0 .4em}.dalembert figcaption{color:var(--grey);font-size:.85em}.dalembert .panel{border-top:1px solid var(--rim);padding:.3em 0}.dalembert summary{cursor:pointer;padding:.15em 0;font-weight:600}.dalembert select{font:inherit;color:inherit;background:var(--soft);border:1px solid var(--rim);border-radius:.4em;max-width:100%}.dalembert .equation{font-variant-numeric:tabular-nums;overflow-wrap:anywhere;margin:.15em 0;font-size:.85em}.dalembert .answers{border-collapse:collapse;font-variant-numeric:tabular-nums;width:100%;font-size:.85em}.dalembert .answers th{text-align:left;padding:.1em .6em .1em 0;font-weight:400}.dalembert .answers td{text-align:right}.dalembert .answers tr+tr>*{border-top:1px solid var(--soft)}.dalembert .polar{width:49%;padding-right:.6em;display:inline-block}.dalembert fieldset{border:0;border-top:1px solid var(--soft);margin:0;padding:.2em 0;font-size:.88em}.dalembert legend{padding:0 .4em 0 0;font-weight:600}.dalembert fieldset label{grid-template-columns:minmax(0,1fr) 7.5em 4.5em;align-items:center;gap:.4em;margin:.1em 0;display:grid}.dalembert fieldset label input[type=range]{accent-color:var(--accent);grid-column:1/-1}.dalembert fieldset input[type=text]{font:inherit;color:inherit;background:var(--soft);border:1px solid var(--rim);border-radius:.3em;width:100%;padding:.05em .3em}.dalembert input.changed{border-color:var(--accent);font-weight:600}.dalembert .unit{color:var(--grey)}.dalembert .wrong{color:var(--warn);grid-column:1/-1}.dalembert .wrong:empty{display:none}.dalembert input[aria-invalid]{border-color:var(--warn)!important}.dalembert dl{grid-template-columns:auto 1fr;gap:.1em .8em;font-size:.9em;display:grid}.dalembert dd{margin:0}.dalembert .handle{fill:var(--accent);fill-opacity:.1;stroke:var(--accent);stroke-opacity:.35;stroke-width:.25px;cursor:grab;outline:none}.dalembert .handle:hover,.dalembert .handle:focus-visible{fill-opacity:.3;stroke-opacity:1;outline:none}.dalembert .handle.center{fill:#1a7f4b;stroke:#1a7f4b}.dalembert .handle.load{fill:#c1272d;stroke:#c1272d}.dalembert .handle.direction{fill:#7a2fa0;stroke:#7a2fa0}.dalembert .span *{vector-effect:non-scaling-stroke}.dalembert .cursor{stroke:var(--grey);stroke-width:.3px;fill:none}.dalembert .key{cursor:pointer}.dalembert .key.picked{text-decoration:underline}.dalembert .chart svg{cursor:crosshair}.dalembert [data-item]{cursor:pointer}.dalembert select.speed{padding:.1em}.dalembert.unsolved svg:not(.chart svg)>g:not(.gaps){opacity:.3}@container (width<=500px){.dalembert .bar{flex-wrap:wrap;gap:.3em}.dalembert .bar input{flex-basis:100%;order:-1}.dalembert .tabs button{padding:.2em .35em;font-size:.93em}.dalembert .readout{min-width:0;margin-right:auto}.dalembert button{padding:.15em .45em}}@container (width<=760px){.dalembert main{padding:.4em .6em;display:block}.dalembert .stage,.dalembert.full .stage{position:static}.dalembert .paper,.dalembert.full .paper{aspect-ratio:1;width:100%;max-height:56vh}.dalembert .polar{width:100%}.dalembert .mark{right:0}.dalembert.full main{overflow-y:auto}.dalembert.full .side{display:block}.dalembert.full .panels{overflow:visible}.dalembert .tabs{background:var(--paper);z-index:1;position:sticky;top:0}}@media (prefers-color-scheme:dark){.dalembert{--ink:#e8edf2;--grey:#9aa7b4;--paper:#151b22;--soft:#222b35;--rim:#323d48;--warn:#ff7b74;--accent:#6fa8f5}}@media print{.dalembert{--ink:#000;--grey:#444;--paper:#fff;--soft:#fff;--rim:#999;--accent:#000}.dalembert header,.dalembert .stage{position:static}.dalembert.full{height:auto;display:block;overflow:visible}.dalembert .paper,.dalembert.full .paper{aspect-ratio:10/7;max-height:none}.dalembert.full .side,.dalembert.full .panels{display:block;overflow:visible}.dalembert .mark{position:static}.dalembert .bar,.dalembert .switches,.dalembert .handles,.dalembert .tabs,.dalembert .menu,.dalembert [data-tab=Save],.dalembert select{display:none}.dalembert main{display:block}.dalembert figure,.dalembert .panel{break-inside:avoid}}" + t.style.light + f;
		let p = o.length ? () => void u() : void 0, m = t.format === "dalembert-sketch/1" ? await Gt(c, t, r, {
			...s,
			taken: l,
			back: p
		}) : t.format === "dalembert-page/1" ? await Gn(c, t, r, {
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
	async function f(e, t, n = !1) {
		o.length = 0, await p(e, t, n);
	}
	async function p(e, t = s.pose(), r = !1) {
		let i = s;
		s = await c(e, {
			...n,
			changes: void 0,
			address: !1,
			pose: t ?? void 0,
			anew: r
		}), i.remove(), n.on?.({ type: "put" });
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
		view: r,
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
async function qn(e, t) {
	try {
		return await Kn(e, JSON.parse(new TextDecoder().decode(await H(t))), {
			address: location.protocol !== "about:",
			full: !0
		});
	} catch (t) {
		throw e.textContent = String(t), t;
	}
}
var Jn = { async render({ model: e, el: t }) {
	let n = "", r = Ye(), a = (t) => {
		n = JSON.stringify(t), e.set("changes", t), e.save_changes();
	}, o = (t) => {
		(t.type === "put" || t.type === "pose" || t.type === "change" && e.get("text")) && (e.set("text", c.text()), e.save_changes());
	}, s = async () => {
		let n = await Kn(t, e.get("data"), {
			edited: a,
			on: o,
			changes: e.get("changes"),
			view: r
		});
		return i("style", t, {}, `[data-dalembert="${e.get("frame")}"]{display:none}`), n;
	}, c = await s(), l = async () => {
		r.window = null, c.remove(), c = await s();
	}, u = () => JSON.stringify(e.get("changes")) !== n && c.set(e.get("changes"));
	return e.on("change:data", l), e.on("change:changes", u), () => {
		e.off("change:data", l), e.off("change:changes", u), c.remove();
	};
} };
export { Jn as default, Kn as mount, qn as open };
