// src/kernel.ts
function e(e) {
	return Uint8Array.from(atob(e), (e) => e.charCodeAt(0));
}
function t(t) {
	if (typeof t == "string") return new Float64Array(e(t).buffer);
	let n = (t.to - t.from) / Math.max(t.count - 1, 1);
	return Float64Array.from({ length: t.count }, (e, r) => r === t.count - 1 ? t.to : t.from + r * n);
}
async function n(t) {
	let n = new Blob([e(t)]).stream().pipeThrough(new DecompressionStream("deflate"));
	return new Response(n).arrayBuffer();
}
var r = class e {
	run;
	values;
	path;
	out;
	row;
	places = [];
	constructor(e, t, n, r) {
		this.run = e, this.row = n.row;
		let i = [
			r,
			n.channels.length * n.row,
			(n.outputs + 1) * n.row
		], a = n.heap;
		for (let e of i) this.places.push(a), a = a + 8 * e + 15 & -16;
		a > t.buffer.byteLength && t.grow(Math.ceil((a - t.buffer.byteLength) / 65536)), [this.values, this.path, this.out] = i.map((e, n) => new Float64Array(t.buffer, this.places[n], e));
	}
	static async create(t, r) {
		let { instance: i } = await WebAssembly.instantiate(await n(t.wasm)), { memory: a, run: o } = i.exports;
		return new e(o, a, t, r);
	}
	call(e) {
		this.run(this.places[0], this.places[1], this.places[2], Math.ceil(e / 2));
	}
}, i = class {
	table;
	breaks;
	pieces;
	constructor(e) {
		this.table = e, this.breaks = t(e.breaks), this.pieces = t(e.pieces);
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
}, a = class e {
	data;
	whole;
	one;
	slope;
	rows;
	row;
	count;
	here;
	finite = !0;
	good;
	cyclic;
	values;
	positions;
	channels;
	constructor(e, n, r, a) {
		this.data = e, this.whole = n, this.one = r, this.slope = a, this.count = e.kernel.count, this.row = e.kernel.row, this.values = n.values, this.values.set(e.numbers.map((e) => e.value)), this.rows = n.out, this.good = new Uint8Array(this.count), this.here = new Float64Array(e.kernel.outputs + 1), this.positions = new Map(e.drives.map((e) => [e.name, t(e.position)])), this.channels = new Map(e.channels.map((e) => [e.name, {
			values: t(e.values),
			pieces: e.table && new i(e.table),
			drive: e.table ? e.table.drive : e.name.replace(/^position /, "")
		}])), e.kernel.channels.forEach((e, t) => {
			let r = this.channels.get(e).values;
			for (let e = 0; e < this.row; e++) n.path[t * this.row + e] = r[Math.min(e, this.count - 1)];
		}), this.cyclic = !e.only_at_positions && e.drives.some((e) => e.turns && this.closes(e.name));
	}
	static async create(t) {
		let n = t.numbers.length, [i, a, o] = await Promise.all([
			r.create(t.kernel, n),
			r.create(t.kernel, n),
			t.gradient ? r.create(t.gradient, n) : void 0
		]);
		return new e(t, i, a, o);
	}
	closes(e) {
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
		let a = r + 1 < n.length ? n[r + 1] : this.closes(e) ? n[r] + (n[1] - n[0]) : n[0];
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
		this.whole.call(this.count);
		for (let e = 0; e < this.count; e++) this.good[e] = +this.numbered(this.markAt(e));
	}
	at(e) {
		this.load(this.one, this.data.kernel.channels, e), this.one.values.set(this.values), this.one.call(1), this.finite = !0;
		for (let e = 0; e < this.here.length; e++) this.here[e] = this.one.out[e * this.one.row], Number.isFinite(this.here[e]) || (this.finite = !1);
	}
	other(e, t) {
		this.one.values.set(e), this.one.call(1);
		for (let e = 0; e < t.length; e++) t[e] = this.one.out[e * this.one.row];
	}
	gradient(e, t) {
		let n = this.data.gradient, r = this.slope;
		this.load(r, n.channels, t), r.values.set(this.values), r.call(1);
		let i = n.numbers.length;
		return Float64Array.from({ length: i }, (t, n) => r.out[(e * i + n) * r.row]);
	}
	load(e, t, n) {
		t.forEach((t, r) => {
			e.path[r * e.row] = e.path[r * e.row + 1] = this.input(t, n);
		});
	}
	numbered(e) {
		return this.data.statuses[e].numbered;
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
		return this.rows[e * this.row + t];
	}
	largest(e) {
		let t = 0;
		for (let n = 0; n < this.count; n++) this.good[n] && (t = Math.max(t, e(n)));
		return t;
	}
}, o = "http://www.w3.org/2000/svg";
function s(e, t) {
	for (let [n, r] of Object.entries(t)) e.setAttribute(n, String(r));
	return e;
}
function c(e, t, n = {}) {
	let r = s(document.createElementNS(o, e), n);
	return t?.append(r), r;
}
function l(e, t, n = {}, r = "") {
	let i = s(document.createElement(e), n);
	return r && (i.textContent = r), t?.append(i), i;
}
function u(e) {
	let t = Math.round(100 * Math.abs(e)), n = Math.floor(t / 100), r = t % 100;
	return (e < 0 && t ? "-" : "") + n + (r ? (r < 10 ? ".0" : ".") + r : "");
}
function d(e, t = !1) {
	return e.length ? "M" + e.map(([e, t]) => u(e) + " " + u(t)).join("L") + (t ? "Z" : "") : "";
}
function f(e, t, n) {
	e.setAttribute("transform", `translate(${u(t)} ${u(n)})`);
}
function p(e, t) {
	let n = new DOMPoint(t.clientX, t.clientY).matrixTransform(e.getScreenCTM().inverse());
	return [n.x, n.y];
}
function m(e, t, n) {
	e.replaceChildren();
	let r = !1;
	for (let i of t.split(/(_\{[^}]*\})/)) {
		if (!i) continue;
		let t = i.startsWith("_{"), a = c("tspan", e, t ? { "font-size": .7 * n } : {});
		a.textContent = t ? i.slice(2, -1) : i, t !== r && a.setAttribute("dy", String((t ? .25 : -.25) * n)), r = t;
	}
}
var h = (e) => e.replace(/_\{([^}]*)\}/g, "$1"), g = null, _ = /* @__PURE__ */ new Map();
function v(e, t, n = !1) {
	let r = `${n}${e}`, i = _.get(r);
	if (i === void 0) {
		g ??= document.createElement("canvas").getContext("2d"), g.font = `${n ? "bold " : ""}100px "DejaVu Sans", "Helvetica Neue", Arial, sans-serif`, i = 0;
		for (let t of e.split(/(_\{[^}]*\})/)) {
			let e = t.startsWith("_{");
			i += g.measureText(e ? t.slice(2, -1) : t).width / 100 * (e ? .7 : 1);
		}
		_.set(r, i);
	}
	return i * t;
}
function y(e, t, n, r, i = "middle") {
	let a = c("text", e, {
		class: `l-${t}-t`,
		"font-size": r,
		"text-anchor": i
	});
	return m(a, n, r), a;
}
var b = class {
	g;
	shaft;
	head;
	constructor(e, t, n = "") {
		this.g = c("g", e), n && (c("title", this.g).textContent = h(n)), this.shaft = c("path", this.g, {
			class: `l-${t}`,
			style: "fill:none"
		}), this.head = c("path", this.g, { class: `l-${t}-h` });
	}
	set(e, t, n = .3) {
		let r = t[0] - e[0], i = t[1] - e[1], a = Math.hypot(r, i), o = a > n && Number.isFinite(a);
		if (this.g.setAttribute("display", o ? "inline" : "none"), !o) return !1;
		let s = r / a, c = i / a, l = Math.min(3, .75 * a), u = .3 * l, f = [t[0] - l * s, t[1] - l * c];
		return this.shaft.setAttribute("d", d([e, [t[0] - .8 * l * s, t[1] - .8 * l * c]])), this.head.setAttribute("d", d([
			t,
			[f[0] - u * c, f[1] + u * s],
			[f[0] + u * c, f[1] - u * s]
		], !0)), !0;
	}
};
function x(e) {
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
// src/labels.ts
var S = [
	[1, -1],
	[-1, -1],
	[1, 1],
	[-1, 1],
	[0, -1],
	[1, 0],
	[-1, 0],
	[0, 1]
], C = [
	1,
	1.9,
	3,
	4.5
];
function w(e, t, n, r) {
	return {
		el: y(e, t, n, r),
		text: n,
		size: r,
		bold: t === "title",
		choice: -1
	};
}
var T = class {
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
		let t = e.label, n = v(t.text, t.size, t.bold) + .5, r = 1.1 * t.size + (t.text.includes("_") ? .3 * t.size : 0), i = e.leave ?? 1.2, a = e.away && Math.hypot(...e.away) || 1, o = Infinity, s = 0, c = [
			0,
			0,
			0,
			0
		], l = 0;
		for (let [u, d] of e.anchors) for (let f of C) for (let [p, m] of S) {
			let h = i * f, g = u + p * (h + n / 2), _ = d + m * (h + r / 2), v = [
				g - n / 2,
				_ - r / 2,
				g + n / 2,
				_ + r / 2
			], y = l % 32 * .12 + .2 * Math.floor(l / 32) - (l === t.choice ? .4 : 0);
			e.away && (y += 1.2 * (1 - (p * e.away[0] + m * e.away[1]) / (Math.hypot(p, m) * a))), y < o && (y += this.cost(v)) < o && (o = y, s = l, c = v), l++;
		}
		t.choice = s, this.texts.push(c), f(t.el, (c[0] + c[2]) / 2, c[1] + .91 * t.size);
	}
	cost(e) {
		let t = 0;
		for (let n of this.texts) E(e, n) > 0 && (t += 60 + 5 * E(e, n));
		for (let n of this.discs) E(e, n) > 0 && (t += 8 + E(e, n));
		for (let [n, r] of this.lines) D(e, n, r) && (t += 6);
		let [n, r, i, a] = this.bounds;
		return (e[0] < n || e[1] < r || e[2] > i || e[3] > a) && (t += 20), t;
	}
};
function E(e, t) {
	let n = Math.min(e[2], t[2]) - Math.max(e[0], t[0]), r = Math.min(e[3], t[3]) - Math.max(e[1], t[1]);
	return n > 0 && r > 0 ? n * r : 0;
}
function D(e, t, n) {
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
var O = (e, t, n) => t.reduce((t, r, i) => t + e[i] * n(r), 0), k = class {
	kernel;
	perMm;
	middle = [0, 0];
	axes = [[1, 0], [0, 1]];
	azimuth = -Math.PI / 3;
	elevation = .45;
	constructor(e, t, n) {
		this.kernel = e, this.perMm = t, n && this.turn(0, 0);
	}
	turn(e, t) {
		this.azimuth += e, this.elevation = Math.min(Math.max(this.elevation + t, -1.55), 1.55);
		let n = Math.cos(this.azimuth), r = Math.sin(this.azimuth), i = Math.cos(this.elevation), a = Math.sin(this.elevation);
		this.axes = [
			[
				-r,
				n,
				0
			],
			[
				-a * n,
				-a * r,
				i
			],
			[
				i * n,
				i * r,
				a
			]
		];
	}
	seen(e, t) {
		return e.length < 3 ? [t(e[0]), t(e[1])] : [O(this.axes[0], e, t), O(this.axes[1], e, t)];
	}
	depth(e) {
		return O(this.axes[2], e, (e) => this.kernel.here[e]);
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
function A(e, t, n) {
	let r = n.kernel.here;
	if (t.t === "symbol") {
		let i = c("g", e, t.per_mm ? { class: "span" } : {});
		return i.innerHTML = t.svg, {
			update() {
				let [e, a] = n.point(t.p), o = t.per_mm ? ` scale(${(t.per_mm / n.perMm).toFixed(4)})` : "", s = t.e ? ` rotate(${u(-Math.atan2(r[t.e[1]], r[t.e[0]]) * 180 / Math.PI)})` : "";
				i.setAttribute("transform", `translate(${u(e)} ${u(a)})${s}${o}`);
			},
			mark: (e) => e.disc(n.point(t.p), 1.6)
		};
	}
	if (t.t === "span") {
		let r = c("g", e, { class: "span" });
		return r.innerHTML = t.svg, {
			update() {
				let [[e, i], [a, o]] = t.p.map((e) => n.point(e)), s = Math.hypot(a - e, o - i), c = Math.atan2(o - i, a - e) * 180 / Math.PI;
				r.setAttribute("transform", `translate(${u(e)} ${u(i)}) rotate(${u(c)}) scale(${(s / t.length).toFixed(4)} 1)`);
			},
			mark: (e) => e.line(n.point(t.p[0]), n.point(t.p[1]))
		};
	}
	if (t.t === "circle") {
		let i = c("circle", e, { class: `l-${t.role}` });
		return { update() {
			let [e, a] = n.point(t.p);
			s(i, {
				cx: u(e),
				cy: u(a),
				r: u(Math.abs(r[t.r]) / n.perMm)
			});
		} };
	}
	if (t.t === "pair") return j(e, t, n);
	let i = c("path", e, {
		class: `l-${t.role}`,
		style: "fill:none"
	});
	if (t.t === "trace") return { update: () => i.setAttribute("d", M(n.kernel, (e) => n.pointAt(t.p[0], e), !0)) };
	t.t === "hull" && (i.dataset.link = t.link);
	let a = [], o = !1;
	return {
		update() {
			let e = t.p.map((e) => n.point(e)), r = t.t === "hull" ? x(e) : e;
			o = t.t === "hull" && r.length > 2, a = o ? r : e, t.t === "hull" && i.setAttribute("class", o ? "l-link-area" : "l-link"), i.style.fill = o ? "" : "none", i.setAttribute("d", d(a, o));
		},
		mark(e) {
			a.forEach((t, n) => (n || o) && e.line(a.at(n - 1), t));
		}
	};
}
function j(e, t, n) {
	let r = c("g", e), i = t.fixed ? "support" : "block", a = c("path", r, { class: `l-${i}` }), o = c("path", r, { class: `l-${t.shape === "ball" ? i : "pin"}` }), s = t.shape === "block" ? 4.2 : 3.4, l = t.shape === "block" ? 2.2 : 1.7;
	return {
		update() {
			let [e, i] = n.point(t.p), [c, d] = n.here(t.e), f = n.depth(t.e);
			if (r.setAttribute("transform", `translate(${u(e)} ${u(i)}) rotate(${u(-Math.atan2(d, c) * 180 / Math.PI)})`), t.shape === "ball") return a.setAttribute("d", `M${l} 0A${l} ${l} 0 1 0 ${-l} 0A${l} ${l} 0 1 0 ${l} 0Z`);
			let p = s * Math.hypot(c, d), m = l * Math.abs(f), h = f >= 0 ? p : -p;
			t.shape === "round" ? (a.setAttribute("d", `M${u(-p)} ${-l}L${u(p)} ${-l}A${u(m)} ${l} 0 0 1 ${u(p)} ${l}L${u(-p)} ${l}A${u(m)} ${l} 0 0 1 ${u(-p)} ${-l}Z`), o.setAttribute("d", `M${u(h + m)} 0A${u(m)} ${l} 0 1 0 ${u(h - m)} 0A${u(m)} ${l} 0 1 0 ${u(h + m)} 0Z`)) : (a.setAttribute("d", `M${u(-p - m)} ${-l}H${u(p + m)}V${l}H${u(-p - m)}Z`), o.setAttribute("d", `M${u(h - m)} ${-l}H${u(h + m)}V${l}H${u(h - m)}Z`));
		},
		mark: (e) => e.disc(n.point(t.p), 2.4)
	};
}
function M(e, t, n = !1) {
	let r = n && e.cyclic ? e.count : e.count - 1, i = "", a = !1;
	for (let n = 0; n <= r; n++) {
		let r = n % e.count, o = !!e.good[r];
		if (o) {
			let [e, n] = t(r);
			i += (a ? "L" : "M") + u(e) + " " + u(n);
		}
		a = o;
	}
	return i;
}
function N(e, t, n, r, i) {
	return t.t === "couple" ? L(e, t, n) : F(e, t, n, r, i);
}
var P = 13;
function F(e, t, n, r, i) {
	let a = new b(e, t.role, t.name), o = t.t === "force" ? null : new b(e, t.role), s = t.t === "force" ? t.f : t.m, c = w(e, t.role, t.name, 3.4), l = [0, 0], u = [0, 0], d = [0, 0], f = !1;
	return {
		label: c,
		update() {
			let e = n.point(t.p), [p, m] = n.here(s), h = o ? Math.hypot(...s.map((e) => n.kernel.here[e])) / P || 1 : r(), g = [p / h, -m / h], _ = !1;
			if (i && i.length > 1 && !o) {
				let t = i.map((e) => n.point(e)), r = [0, 1].map((e) => t.reduce((t, n) => t + n[e], 0) / t.length);
				_ = g[0] * (r[0] - e[0]) + g[1] * (r[1] - e[1]) > 1e-9;
			}
			[l, u] = _ ? [[e[0] - g[0], e[1] - g[1]], e] : [e, [e[0] + g[0], e[1] + g[1]]], d = _ ? l : u, f = a.set(l, u), o?.set(l, [l[0] + .78 * (u[0] - l[0]), l[1] + .78 * (u[1] - l[1])]), c.el.setAttribute("visibility", f ? "visible" : "hidden");
		},
		mark: (e) => f && e.line(l, u),
		anchor() {
			if (!f) return null;
			let e = d === l ? u : l, t = [d[0] - e[0], d[1] - e[1]];
			return [
				d,
				[d[0] - .35 * t[0], d[1] - .35 * t[1]],
				t
			];
		}
	};
}
var I = 4.6;
function L(e, t, n) {
	let r = n.kernel.here, i = c("g", e), a = w(e, t.role, t.name, 3.4);
	c("title", i).textContent = h(t.name), c("path", i, {
		class: `l-${t.role}`,
		style: "fill:none",
		d: "M4.17 1.94A4.6 4.6 0 1 0 -4.17 1.94"
	}), c("path", i, {
		class: `l-${t.role}-h`,
		d: "M-4.17 2.9L-5.6 -0.1L-3 0.3Z"
	});
	let o = !1;
	return {
		label: a,
		update() {
			let [e, s] = n.point(t.p), c = r[t.m[0]];
			o = Number.isFinite(c) && Math.abs(c) > 1e-9, i.setAttribute("display", o ? "inline" : "none"), a.el.setAttribute("visibility", o ? "visible" : "hidden"), i.setAttribute("transform", `translate(${u(e)} ${u(s)}) scale(${c < 0 ? -1 : 1} 1)`);
		},
		mark(e) {
			o && e.disc(n.point(t.p), I);
		},
		anchor() {
			let [e, r] = n.point(t.p);
			return o ? [[e, r - I], [0, -1]] : null;
		}
	};
}
// src/board.ts
var R = [
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
function z(e) {
	if (!(e > 0) || !Number.isFinite(e)) return 1;
	let t = 10 ** Math.floor(Math.log10(e) + 1e-12);
	return t * (R.find((n) => n * t >= e * (1 - 1e-12)) ?? 10);
}
function B(e) {
	let t = (e) => [Math.min(...e), Math.max(...e)], n = t(e.map((e) => e[0])), r = t(e.map((e) => e[1]));
	return Number.isFinite(n[0] + n[1] + r[0] + r[1]) ? {
		x: n,
		y: r
	} : null;
}
var V = (e) => e.t === "hull" || e.t === "path" ? e.p : e.t === "symbol" || e.t === "pair" ? [e.p] : [];
function H(e, t) {
	let n = e.kernel, r = Math.max(1, Math.floor(n.count / 72)), i = [];
	for (let a of t.items.flatMap(V)) for (let t = 0; t < n.count; t += r) n.good[t] && i.push(e.seen(a, (e) => n.value(e, t)));
	return B(i);
}
var ee = (e) => e.items.some((e) => e.t === "pair");
function te(e, t, n) {
	let r = H(new k(e, 1, ee(t)), t), i = r ? (r.y[1] - r.y[0]) / (r.x[1] - r.x[0]) : NaN;
	return Number.isFinite(i) ? n * Math.min(Math.max(i * 1.05, .56), .9) : .7 * n;
}
function U(e, t, n, r) {
	return c("svg", e, {
		viewBox: `${-t / 2} ${-n / 2} ${t} ${n}`,
		role: "group",
		"aria-label": r
	});
}
function ne(e, t, n, r, i, a, o, s) {
	let l = {
		length: o.length.size,
		force: o.force.size
	}, u = U(e, i, a, s), d = new k(t, n.per_mm, ee(n)), f = [], p = [], m = n.force;
	n.middle && (d.middle = n.middle);
	let h = c("g", u), g = c("g", u), _ = c("g", u);
	for (let e of n.items) (e.t === "trace" ? f : p).push(A(h, e, d));
	let v = n.arrows.map((e) => N(g, e, d, () => m, r ?? void 0)), y = n.labels.map((e) => ({
		l: w(_, e.role, e.text, e.kind === "joint" ? 3.8 : 3.3),
		p: e.p,
		q: e.q
	})), b = c("text", _, {
		class: "l-note-t",
		"font-size": 2.8,
		x: -i / 2 + 2,
		y: a / 2 - 2
	});
	function x(e) {
		e && (d.middle = [(e.x[0] + e.x[1]) / 2, (e.y[0] + e.y[1]) / 2]);
	}
	function S() {
		let e = r ? B(r.map((e) => d.here(e))) : H(d, n);
		if (e) {
			let t = r ? [46, 40] : [i * .76, a * .74], o = Math.max((e.x[1] - e.x[0]) / t[0], (e.y[1] - e.y[0]) / t[1]) || n.per_mm;
			x(e), d.perMm = z(o / l.length) * l.length;
		}
		let o = Math.max(0, ...n.arrows.map((e) => e.t === "force" ? t.largest((n) => Math.hypot(...e.f.map((e) => t.value(e, n)))) : 0));
		o > 0 && (m = z(o / (r ? 26 : 22) / l.force) * l.force);
	}
	function C() {
		let e = new T([
			-i / 2,
			-a / 2,
			i / 2,
			a / 2 - 4
		]);
		for (let t of [...p, ...v]) t.mark?.(e);
		for (let { l: t, p: n, q: r } of y) {
			let i = E.names || !!r;
			if (t.el.setAttribute("visibility", i ? "visible" : "hidden"), !i) continue;
			let a = d.point(n), o = r ? d.point(r) : a, s = (r ? [
				.5,
				.35,
				.65
			] : [0]).map((e) => [a[0] + e * (o[0] - a[0]), a[1] + e * (o[1] - a[1])]);
			e.put({
				label: t,
				anchors: s,
				away: r ? void 0 : a,
				leave: r ? .8 : 1.3
			});
		}
		for (let n of v) {
			let r = t.solved ? n.anchor() : null;
			r ? e.put({
				label: n.label,
				anchors: r.slice(0, -1),
				away: r[r.length - 1],
				leave: .9
			}) : n.label.el.setAttribute("visibility", "hidden");
		}
	}
	let E = {
		svg: u,
		paper: d,
		fit: S,
		force: () => m,
		names: n.labels.filter((e) => e.kind === "joint").length <= 8,
		update(e) {
			if (e && f.forEach((e) => e.update()), g.setAttribute("visibility", t.solved ? "visible" : "hidden"), t.finite) {
				r && x(B(r.map((e) => d.here(e))));
				for (let e of [...p, ...v]) e.update();
				C(), b.textContent = `1 mm = ${+(d.perMm / l.length).toPrecision(4)} ${o.length.unit}, ${+(m / l.force).toPrecision(4)} ${o.force.unit}`;
			}
		}
	};
	return E;
}
// src/charts.ts
var re = 16, ie = 5, ae = 8, oe = 4;
function W(e, t) {
	let n = e / t || 1, r = 10 ** Math.floor(Math.log10(n));
	return r * ([
		1,
		2,
		5,
		10
	].find((e) => e * r >= n) ?? 10);
}
function G(e, t, n) {
	let r = Math.ceil(e / n - 1e-9), i = Math.floor(t / n + 1e-9) - r + 1;
	return Array.from({ length: Math.max(i, 0) }, (e, t) => (r + t) * n);
}
var K = (e, t = 4) => Number.isFinite(e) ? String(+e.toPrecision(t)).replace("-", "−") : "–";
function se(e, t, n, r, i, a) {
	let o = l("figure", e, { class: "chart" }), d = t.units[r.kind];
	l("figcaption", o, {}, `${r.title}, ${d.unit}`);
	let f = t.views.charts.flatMap((e) => e.curves.map((e) => v(e.name, 3))), h = Math.min(Math.max(...f) + 4, .3 * a), g = Math.max(52, 13 + oe * r.curves.length), _ = U(o, a, g, r.title), y = a - re - h, b = g - ie - ae, x = -a / 2 + re, S = -g / 2 + ie, C = c("path", _, {
		class: "l-grid",
		style: "fill:none"
	}), w = c("path", _, {
		class: "l-axis",
		style: "fill:none"
	}), T = c("g", _), E = r.curves.map((e) => c("path", _, {
		class: `l-${e.role}`,
		style: "fill:none"
	})), D = c("path", _, { class: "cursor" }), O = r.curves.map((e) => c("circle", _, {
		class: `l-${e.role}-h`,
		r: .9
	})), k = Math.max(n.count - 1, 1), A = t.noise[r.kind] ?? 0, j = r.curves.map((e, t) => {
		let n = c("text", _, {
			class: `l-${e.role}-t key`,
			"font-size": 3,
			x: x + y + 2,
			y: S + 3 + oe * t,
			tabindex: 0,
			role: "button"
		});
		return m(n, e.name, 3), c("title", n).textContent = "show what lowers its peak", n.addEventListener("click", () => i.pick(e)), n.addEventListener("keydown", (t) => t.key === "Enter" && i.pick(e)), n;
	}), N = (e, t) => {
		let r = n.value(e.row, t) / d.size;
		return Math.abs(r) * d.size < A ? 0 : r;
	}, P = NaN, F = NaN, I = (e) => x + e / k * y, L = (e) => S + b - (e - P) / (F - P) * b;
	function R() {
		let [e, t] = [Infinity, -Infinity];
		for (let i of r.curves) for (let r = 0; r < n.count; r++) if (n.good[r]) {
			let n = N(i, r);
			e = Math.min(e, n), t = Math.max(t, n);
		}
		e <= t || ([e, t] = [0, 1]), e > 0 && e < .4 * t && (e = 0), t < 0 && t > .4 * e && (t = 0), t - e < 1e-9 * Math.max(Math.abs(t), Math.abs(e), 1e-9) && ([e, t] = [Math.min(e, 0), Math.max(t, 0) || 1]);
		let i = W(t - e, 4);
		return [e, t] = [Math.floor(e / i + 1e-9) * i, Math.ceil(t / i - 1e-9) * i], e === P && t === F ? !1 : ([P, F] = [e, t], !0);
	}
	function z() {
		let e = t.drives[0], r = W(F - P, 4), i = (e, t, n, r) => c("text", T, {
			class: "l-note-t",
			"font-size": 2.6,
			"text-anchor": r,
			x: t,
			y: n
		}).textContent = e;
		T.replaceChildren();
		let a = "";
		for (let e of G(P, F, r)) a += `M${x} ${u(L(e))}h${y}`, i(K(e, 5), x - 1.2, L(e) + .9, "end");
		if (e) {
			let [t, r] = [0, k].map((t) => n.position(e.name, t) / e.size);
			for (let n of G(Math.min(t, r), Math.max(t, r), W(Math.abs(r - t), 5))) {
				let o = x + (n - t) / (r - t || 1) * y;
				a += `M${u(o)} ${S}v${b}`, i(K(n, 5) + (e.unit === "°" ? "°" : ""), o, S + b + 3.4, "middle");
			}
			i(`${e.name}, ${e.unit}`, x + y, S + b + 6.6, "end");
		}
		C.setAttribute("d", a), w.setAttribute("d", `M${x} ${S}v${b}` + (P < 0 && F > 0 ? `M${x} ${u(L(0))}h${y}` : ""));
	}
	let B = (e) => i.seek((p(_, e)[0] - x) / y * k);
	return _.addEventListener("pointerdown", (e) => {
		e.target.closest(".key") || (_.setPointerCapture(e.pointerId), B(e));
	}), _.addEventListener("pointermove", (e) => e.buttons && _.hasPointerCapture(e.pointerId) && B(e)), { update(e) {
		e && (R() && z(), E.forEach((e, t) => e.setAttribute("d", M(n, (e) => [I(e), L(N(r.curves[t], e))]))));
		let t = u(I(Math.min(i.time(), k)));
		D.setAttribute("d", `M${t} ${S}v${b}`), r.curves.forEach((e, r) => {
			let a = n.solved ? {
				cx: t,
				cy: u(L(n.here[e.row] / d.size))
			} : {};
			s(O[r], {
				visibility: n.solved ? "visible" : "hidden",
				...a
			}), j[r].classList.toggle("picked", i.picked() === e);
		});
	} };
}
function ce(e, t, n, r) {
	let i = l("figure", e, { class: "polar" }), [a, o] = n.f, s = l("figcaption", i), u = U(i, 66, 66, `polar diagram of joint ${n.name}`);
	c("path", u, {
		class: "l-grid",
		style: "fill:none",
		d: "M-30 0H30M0 -30V30M15 0A15 15 0 1 0 -15 0A15 15 0 1 0 15 0M30 0A30 30 0 1 0 -30 0A30 30 0 1 0 30 0"
	});
	let d = c("path", u, {
		class: `l-${n.role}`,
		style: "fill:none"
	}), f = new b(u, "joint-force", n.name), p = 1;
	return { update(e) {
		e && (p = z(t.largest((e) => Math.hypot(t.value(a, e), t.value(o, e))) / 28 / r.size) * r.size, d.setAttribute("d", M(t, (e) => [t.value(a, e) / p, -t.value(o, e) / p], !0)), s.textContent = `Joint ${n.name}: 1 mm = ${K(p / r.size)} ${r.unit}`), f.set([0, 0], t.solved ? [t.here[a] / p, -t.here[o] / p] : [0, 0]);
	} };
}
function q(e, t, n, r, i) {
	let a = l("figure", e, { class: "polygon" }), o = t.units.force;
	l("figcaption", a, {}, r);
	let s = U(a, 110, 80, r), u = c("g", s), f = /* @__PURE__ */ new Set(), p = i.map(({ sides: e }) => {
		let t = e.find((e) => e.kind === "joint" && f.has(e.of));
		for (let t of e) t.kind === "joint" && f.add(t.of);
		return {
			shared: t,
			drawn: e.filter((e) => e !== t).map((e) => ({
				s: e,
				arrow: new b(s, e.role, e.name),
				name: w(u, e.role, e.name, 3)
			}))
		};
	}), m = c("path", s, {
		class: "l-gap",
		style: "fill:none"
	}), h = c("text", s, {
		class: "l-note-t",
		"font-size": 2.8,
		x: -53,
		y: 38
	});
	return {
		figure: a,
		update() {
			if (s.setAttribute("visibility", n.solved ? "visible" : "hidden"), !n.solved) return;
			let e = n.here, t = /* @__PURE__ */ new Map(), r = [], i = [], a = p.flatMap(({ shared: n, drawn: a }) => {
				let o = B(r)?.y[1] ?? 0, s = t.get(n?.of ?? "") ?? [0, o], c = (t) => [s[0] + e[t[0]], s[1] - e[t[1]]], l = s;
				n && (s = c(n.f));
				let u = a.map((e) => {
					let n = s;
					return s = c(e.s.f), e.s.kind === "joint" && !t.has(e.s.of) && t.set(e.s.of, s), r.push(n, s), {
						...e,
						from: n,
						to: s
					};
				});
				return i.push([l, s]), u;
			}), c = B(r) ?? {
				x: [0, 0],
				y: [0, 0]
			}, l = z(Math.max((c.x[1] - c.x[0]) / 66, (c.y[1] - c.y[0]) / 48) / o.size) * o.size, u = ([e, t]) => [(e - (c.x[0] + c.x[1]) / 2) / l, (t - (c.y[0] + c.y[1]) / 2) / l], f = new T([
				-55,
				-40,
				55,
				36
			]);
			for (let { from: e, to: t } of a) f.line(u(e), u(t));
			for (let { arrow: e, name: t, from: n, to: r } of a) {
				let [i, a] = [u(n), u(r)], o = e.set(i, a), s = [(i[0] + a[0]) / 2, (i[1] + a[1]) / 2];
				t.el.setAttribute("visibility", o ? "visible" : "hidden"), o && f.put({
					label: t,
					anchors: [s],
					away: s,
					leave: .9
				});
			}
			m.setAttribute("d", i.map(([e, t]) => d([u(e), u(t)])).join("")), h.textContent = `1 mm = ${K(l / o.size)} ${o.unit}`;
		}
	};
}
// src/handles.ts
function le(e, t, n, r) {
	let i = c("g", e.svg, { class: "handles" }), a = t.handles.map((t) => de(i, e, t, n, r));
	return fe(e, t, n, r), () => n.finite && a.forEach((e) => e());
}
var J = (e, t) => e.reduce((e, n, r) => e + n * t[r], 0);
function ue(e, t, n, r, [i, a]) {
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
function de(e, t, n, r, i) {
	let a = `${{
		joint: "joint",
		point: "point",
		center: "",
		load: "force",
		direction: "direction of"
	}[n.kind]} ${n.name}`.trim(), o = c("circle", e, {
		class: `handle ${n.kind}`,
		r: n.kind === "joint" ? 2.6 : 2,
		tabindex: 0,
		role: "slider",
		"aria-label": `move ${a}`,
		"aria-valuetext": a,
		"aria-valuenow": 0,
		"data-kind": n.kind,
		"data-name": n.name
	});
	c("title", o).textContent = `drag ${a}`;
	let l = t.paper, d = r.values, f = (e) => e.map((e) => r.here[e]), m = [], h = [], g = [0, 0], _ = [], v = [0, 0], y = !1, b = () => {
		let e = l.point(n.p), r = "f" in n ? l.here(n.f) : "along" in n ? l.here(n.along) : [0, 0], i = n.kind === "direction" ? 16 : 1 / t.force();
		return [e[0] + i * r[0], e[1] - i * r[1]];
	}, x = () => {
		let e = (e, t) => ({
			axes: e.map(f),
			at: f(t)
		});
		m = "ends" in n ? n.ends.map((t) => e(t.axes, t.at)) : [e(n.axes, n.p)], [h, g, _, y] = [
			f(n.p),
			b(),
			"f" in n ? f(n.f) : [],
			!0
		];
	}, S = (e) => l.vector([e[0] - g[0], e[1] - g[1]]), C = (e) => {
		if ("by" in n && n.by) ue(r, l, n.p, n.by, l.metres(e));
		else if ("ends" in n) w(n.ends, S(e));
		else if (n.kind === "direction") {
			let t = l.point(n.p), r = [e[0] - t[0], t[1] - e[1]], [i, a] = m[0].axes.map((e) => J(e, r));
			d[n.direction] = Y(Math.atan2(a, i), d[n.direction]);
		} else T(n, S(e).map((e, n) => _[n] + e / l.perMm * t.force()));
		i.changed();
	}, w = (e, t) => e.forEach((e, n) => {
		let r = h.map((e, r) => e + t[r] - m[n].at[r]);
		e.n.forEach((e, t) => d[e] = J(m[n].axes[t], r));
	}), T = (e, t) => {
		let n = m[0].axes.map((e) => J(e, t));
		if (e.components) return e.components.forEach((e, t) => d[e] = n[t]);
		let r = Math.sign(d[e.size]) || 1;
		e.direction === void 0 ? d[e.size] = r * J(t, _) / (Math.hypot(..._) || 1) : (d[e.direction] = Y(Math.atan2(r * n[1], r * n[0]), d[e.direction]), d[e.size] = r * Math.hypot(...n));
	}, E = () => {
		y && i.finished(), y = !1;
	};
	return o.addEventListener("pointerdown", (e) => {
		e.stopPropagation(), o.setPointerCapture(e.pointerId), x();
		let n = p(t.svg, e);
		v = [g[0] - n[0], g[1] - n[1]];
	}), o.addEventListener("pointermove", (e) => {
		let n = p(t.svg, e);
		y && C([n[0] + v[0], n[1] + v[1]]);
	}), o.addEventListener("pointerup", E), o.addEventListener("pointercancel", E), o.addEventListener("keydown", (e) => {
		let t = {
			ArrowLeft: [-1, 0],
			ArrowRight: [1, 0],
			ArrowUp: [0, -1],
			ArrowDown: [0, 1]
		};
		if (!t[e.key]) return;
		e.preventDefault(), e.stopPropagation(), x();
		let n = e.shiftKey ? 5 : 1;
		C([g[0] + n * t[e.key][0], g[1] + n * t[e.key][1]]), E();
	}), () => {
		if (n.kind === "direction" && y) return;
		let [e, t] = b();
		s(o, {
			visibility: Number.isFinite(e + t) ? "visible" : "hidden",
			cx: u(e),
			cy: u(t)
		});
	};
}
var Y = (e, t) => e - 2 * Math.PI * Math.round((e - t) / (2 * Math.PI));
function fe(e, t, n, r) {
	let i = t.drives[0];
	if (!i || n.count < 2 || !(i.turns || i.along) || i.p.length > 2) return;
	let a = 0, o = 0, s = !1, c = (t) => {
		let n = p(e.svg, t), r = e.paper.point(i.p);
		return i.along ? J(e.paper.metres(n), e.paper.here(i.along)) : Math.atan2(r[1] - n[1], n[0] - r[0]);
	};
	e.svg.addEventListener("pointerdown", (t) => {
		t.target.closest("[data-link]")?.dataset.link === i.link && (e.svg.setPointerCapture(t.pointerId), [a, o, s] = [
			c(t),
			r.time(),
			!0
		]);
	}), e.svg.addEventListener("pointermove", (e) => {
		if (!s) return;
		let t = (n.position(i.name, n.count - 1) - n.position(i.name, 0)) / (n.count - 1), l = c(e), u = o + (i.turns ? Y(l - a, 0) : l - a) / t;
		n.cyclic && (u = (u % n.count + n.count) % n.count), [a, o] = [l, u], r.seek(u);
	}), e.svg.addEventListener("pointerup", () => s = !1);
}
// src/page.css?inline
var pe = ".dalembert{--ink:#1d2733;--grey:#5b6672;--paper:#fff;--soft:#f4f6f8;--rim:#d5dbe1;--warn:#b3261e;--accent:#1c56a8;color:var(--ink);background:var(--paper);outline:none;font:15px/1.45 system-ui,DejaVu Sans,sans-serif}.dalembert *{box-sizing:border-box}.dalembert [hidden]{display:none!important}.dalembert header{z-index:2;background:var(--paper);border-bottom:1px solid var(--rim);padding:.35em .8em;position:sticky;top:0}.dalembert h1{margin:0;font-size:1.15em;display:inline}.dalembert .bar{flex-wrap:wrap;align-items:center;gap:.5em;margin-top:.25em;display:flex}.dalembert .bar input{min-width:8em;accent-color:var(--accent);flex:1}.dalembert .readout{font-variant-numeric:tabular-nums;min-width:9em}.dalembert button{font:inherit;color:inherit;background:var(--soft);border:1px solid var(--rim);cursor:pointer;border-radius:.4em;padding:.15em .6em}.dalembert button:disabled{opacity:.4;cursor:default}.dalembert .mark{color:var(--warn);min-height:1.45em;margin:.1em 0 0;font-size:.92em}.dalembert main{grid-template-columns:minmax(0,7fr) minmax(0,5fr);align-items:start;gap:.8em;padding:.8em;display:grid}.dalembert .stage{position:sticky;top:6.2em}.dalembert svg{touch-action:pan-y;-webkit-user-select:none;user-select:none;width:100%;height:auto;font-family:DejaVu Sans,Helvetica Neue,Arial,sans-serif;display:block;overflow:hidden}.dalembert .stage svg{touch-action:none;max-height:calc(100vh - 9em)}.dalembert .cloud{pointer-events:none;width:100%;position:absolute;top:0;left:0}.dalembert .switches{color:var(--grey);flex-wrap:wrap;gap:1em;font-size:.9em;display:flex}.dalembert .switches label{cursor:pointer;align-items:center;gap:.3em;display:flex}.dalembert figure{margin:0 0 .4em}.dalembert figcaption{color:var(--grey);font-size:.85em}.dalembert .panel{border-top:1px solid var(--rim);padding:.3em 0}.dalembert summary{cursor:pointer;padding:.15em 0;font-weight:600}.dalembert select{font:inherit;color:inherit;background:var(--soft);border:1px solid var(--rim);border-radius:.4em;max-width:100%}.dalembert .equation{font-variant-numeric:tabular-nums;overflow-wrap:anywhere;margin:.15em 0;font-size:.85em}.dalembert .answers{border-collapse:collapse;font-variant-numeric:tabular-nums;width:100%;font-size:.85em}.dalembert .answers th{text-align:left;padding:.1em .6em .1em 0;font-weight:400}.dalembert .answers td{text-align:right}.dalembert .answers tr+tr>*{border-top:1px solid var(--soft)}.dalembert .polar{width:49%;display:inline-block}.dalembert fieldset{border:0;border-top:1px solid var(--soft);margin:0;padding:.2em 0;font-size:.88em}.dalembert legend{padding:0 .4em 0 0;font-weight:600}.dalembert fieldset label{grid-template-columns:minmax(0,1fr) 7.5em 4.5em;align-items:center;gap:.4em;margin:.1em 0;display:grid}.dalembert fieldset label input[type=range]{accent-color:var(--accent);grid-column:1/-1}.dalembert fieldset input[type=number]{font:inherit;color:inherit;background:var(--soft);border:1px solid var(--rim);border-radius:.3em;width:100%;padding:.05em .3em}.dalembert input.changed{border-color:var(--accent);font-weight:600}.dalembert .unit{color:var(--grey)}.dalembert dl{grid-template-columns:auto 1fr;gap:.1em .8em;font-size:.9em;display:grid}.dalembert dd{margin:0}.dalembert .handle{fill:var(--accent);fill-opacity:.1;stroke:var(--accent);stroke-opacity:.35;stroke-width:.25px;cursor:grab;outline:none}.dalembert .handle:hover,.dalembert .handle:focus-visible{fill-opacity:.3;stroke-opacity:1;outline:none}.dalembert .handle.center{fill:#1a7f4b;stroke:#1a7f4b}.dalembert .handle.load{fill:#c1272d;stroke:#c1272d}.dalembert .handle.direction{fill:#7a2fa0;stroke:#7a2fa0}.dalembert .span *{vector-effect:non-scaling-stroke}.dalembert .cursor{stroke:var(--grey);stroke-width:.3px;fill:none}.dalembert .key{cursor:pointer}.dalembert .key.picked{text-decoration:underline}.dalembert .chart svg{cursor:crosshair}.dalembert [data-link]{cursor:pointer}.dalembert.unsolved svg:not(.chart svg){opacity:.3}@media (max-width:500px){.dalembert .bar{gap:.3em}.dalembert .bar input{min-width:3em}.dalembert .readout{min-width:0}.dalembert button{padding:.15em .45em}}@media (max-width:800px){.dalembert main{grid-template-columns:minmax(0,1fr)}.dalembert .stage{position:static}.dalembert .polar{width:100%}}@media (prefers-color-scheme:dark){.dalembert{--ink:#e8edf2;--grey:#9aa7b4;--paper:#151b22;--soft:#222b35;--rim:#323d48;--warn:#ff7b74;--accent:#6fa8f5}}@media print{.dalembert{--ink:#000;--grey:#444;--paper:#fff;--soft:#fff;--rim:#999;--accent:#000}.dalembert header,.dalembert .stage{position:static}.dalembert .bar,.dalembert .switches,.dalembert .handles,.dalembert summary~div>button,.dalembert select{display:none}.dalembert main{display:block}.dalembert figure,.dalembert .panel{break-inside:avoid}}";
// src/panels.ts
function X(e, t, n = !1) {
	let r = l("details", e, { class: "panel" });
	return r.open = n, l("summary", r, {}, t), l("div", r);
}
function me(e, t, n, r) {
	let i = [], a = /* @__PURE__ */ new Map(), o = (t) => {
		let n = a.get(t);
		if (!n) {
			let r = l("fieldset", e);
			l("legend", r, {}, t), a.set(t, n = r);
		}
		return n;
	}, s = t.numbers.map((e, t) => ({
		field: e,
		n: t
	})).sort((e, t) => Number(t.field.parameter ?? !1) - Number(e.field.parameter ?? !1));
	for (let { field: e, n: t } of s) {
		let [a, s] = e.parameter ? ["Parameters", e.label] : he(e.label), u = l("label", o(a), { title: e.about ?? e.path });
		l("span", u, {}, s);
		let d = l("input", u, {
			type: "number",
			step: "any",
			"aria-label": e.label,
			"data-path": e.path
		});
		l("span", u, { class: "unit" }, e.unit);
		let f = {
			box: d,
			n: t,
			field: e
		}, p = (i, a) => {
			Number.isFinite(i) && (n.values[t] = i * e.size, r(a));
		};
		if (d.addEventListener("change", () => d.value.trim() === "" ? c(f) : p(+d.value, !0)), e.parameter) {
			let [t, n] = e.range ?? ge(e.value), r = l("input", u, {
				type: "range",
				min: t / e.size,
				max: n / e.size,
				step: "any",
				"aria-label": `${e.label}, slider`
			});
			f.slide = r, r.addEventListener("input", () => p(+r.value, !1)), r.addEventListener("change", () => p(+r.value, !0));
		}
		i.push(f);
	}
	let c = (e) => {
		let t = n.values[e.n] / e.field.size;
		document.activeElement !== e.box && (e.box.value = String(+t.toPrecision(6))), e.slide && document.activeElement !== e.slide && (e.slide.value = String(t)), e.box.classList.toggle("changed", n.values[e.n] !== e.field.value);
	};
	return { update: () => i.forEach(c) };
}
function he(e) {
	let t = e.indexOf(": ");
	return t < 0 ? ["Others", e] : [e.slice(0, t), e.slice(t + 2)];
}
function ge(e) {
	let t = .5 * Math.abs(e) || 1;
	return [e - t, e + t];
}
function _e(e, t, n) {
	let r = l("tbody", l("table", e, { class: "answers" })), i = t.views.table.map((e) => {
		let n = l("tr", r), i = t.units[e.kind];
		return l("th", n, { scope: "row" }, h(e.name)), {
			r: e,
			unit: i,
			cell: l("td", n)
		};
	});
	return { update() {
		for (let { r: e, unit: t, cell: r } of i) {
			let i = e.rows.map((e) => n.here[e] / t.size), a = (e) => t.unit === "°" ? `${K(e, 5)}°` : `${K(e)} ${t.unit}`;
			r.textContent = n.solved ? i.length === 1 ? a(i[0]) : `${a(Math.hypot(...i))}${i.length === 2 ? ` at ${K(Math.atan2(i[1], i[0]) * 180 / Math.PI)}°` : ""}  (${i.map((e) => K(e)).join(", ")})` : "–";
		}
	} };
}
function ve(e, t, n, r) {
	let { terms: i, about: a } = r.equations, { force: o, moment: s } = t.units, c = i[0]?.f.length ?? 2, u = [
		"x",
		"y",
		"z"
	].slice(0, c).map((e, t) => ({
		head: `ΣF${e}`,
		unit: o,
		sign: (t) => h(t.name) + e,
		row: (e) => e.f[t]
	}));
	(c === 2 ? [""] : [
		"x",
		"y",
		"z"
	]).forEach((e, t) => u.push({
		head: `ΣM${e} about ${a}`,
		unit: s,
		sign: (t) => `M${e}(${h(t.name)})`,
		row: (e) => e.m[t]
	}));
	let d = u.map((t) => ({
		sum: t,
		el: l("p", e, { class: "equation" })
	}));
	return { update() {
		for (let { sum: e, el: t } of d) {
			let r = i.map((t) => n.here[e.row(t)] / e.unit.size), a = Math.max(...r.map(Math.abs), 0), o = r.map((e, t) => ({
				v: e,
				k: t
			})).filter((e) => Math.abs(e.v) > 1e-9 * a);
			if (!n.solved || !o.length) {
				t.textContent = `${e.head}: ${n.solved ? "nothing acts" : "no answer here"}`;
				continue;
			}
			let s = o.map((t) => e.sign(i[t.k])).join(" + "), c = o.reduce((e, t) => e + t.v, 0), l = o.map((e, t) => (e.v < 0 ? t ? " − " : "−" : t ? " + " : "") + K(Math.abs(e.v))).join("");
			t.textContent = `${e.head}: ${s} = ${l} = ${K(Math.abs(c) < 1e-9 * a ? 0 : c)} ${e.unit.unit}`;
		}
	} };
}
function ye(e, t) {
	l("p", e, {}, "Forces and motion are found by one linear system at each position (D'Alembert's principle); every number drawn here is computed anew from the numbers beside it, in double precision.");
	let n = l("dl", e);
	for (let [e, r] of Object.entries(t.assumptions)) l("dt", n, {}, e), l("dd", n, {}, r);
	t.source && l("p", e, {}, `Source: ${t.source}`), l("p", e, {}, `Made with dalembert ${t.version}.`);
}
// src/results.ts
var be = (e) => e.closest("details")?.open ?? !0;
function xe(e, t, n, r, i, a) {
	let { charts: o, bodies: s, polygons: c } = t.views, u = [], d = [];
	if (n.count > 1) for (let i of o) u.push(se(e, t, n, i, r, a ? 88 : 120));
	let f = X(e, "Free body", !0), p = l("select", f, { "aria-label": "link" }), m = s.map((e, r) => {
		l("option", p, { value: r }, `${e.title}${e.member && `, ${e.member} member`}`);
		let i = l("div", f, { class: "body" }), a = ne(i, n, e, e.about, 110, 100, t.units, `free body of ${e.title}`);
		return d.push({
			box: i,
			view: a,
			link: r
		}, {
			box: i,
			view: ve(i, t, n, e),
			link: r
		}), a;
	});
	if (c.links.length) {
		let r = X(e, "Force polygon"), i = X(e, "Force polygons of the chain");
		c.links.forEach((e, i) => {
			let a = q(r, t, n, `Force polygon of link ${e.title}`, [e]);
			d.push({
				box: a.figure,
				view: a,
				link: i
			});
		});
		let a = c.chain.map((e) => c.links[e]);
		d.push({
			box: i,
			view: q(i, t, n, `In the order of solution: ${a.map((e) => e.title).join(" → ")}`, a)
		});
	}
	let h = n.count > 2 ? o.flatMap((e) => e.curves).filter((e) => e.f) : [];
	if (h.length) {
		let r = X(e, "Polar diagrams");
		for (let e of h) d.push({
			box: r,
			view: ce(r, n, e, t.units.force)
		});
	}
	let g = X(e, "Numbers of this position");
	return d.push({
		box: g,
		view: _e(g, t, n)
	}), p.addEventListener("change", i), {
		bodies: m,
		choose(e) {
			let t = s.findIndex((t) => t.link === e);
			t >= 0 && (p.value = String(t)), i();
		},
		update(e) {
			for (let t of u) t.update(e);
			for (let { box: t, view: n, link: r } of d) r !== void 0 && (t.hidden = r !== +p.value), (r === void 0 || r === +p.value) && be(t) && n.update(e);
		}
	};
}
// src/toolbar.ts
function Se(e, t, n, r) {
	let i = l("header", e);
	l("h1", i, {}, t.title);
	let a = l("div", i, {
		class: "bar",
		role: "toolbar",
		"aria-label": "cycle and page"
	}), o = (e, t, n) => {
		let r = l("button", a, {
			type: "button",
			title: t,
			.../^\w/.test(e) ? {} : { "aria-label": t }
		}, e);
		return r.addEventListener("click", n), r;
	}, s = o("▶", "play along the cycle (space)", r.play), c = l("input", a, {
		type: "range",
		min: 0,
		max: n.end,
		step: t.only_at_positions ? 1 : "any",
		"aria-label": "place of the cycle"
	}), u = l("output", a, { class: "readout" }), d = o("↶", "undo (Ctrl+Z)", () => r.go(!0)), f = o("↷", "redo (Ctrl+Y)", () => r.go(!1));
	o("Reset", "all numbers as in the file", r.reset);
	let p = l("p", i, {
		class: "mark",
		role: "status"
	});
	c.addEventListener("input", () => r.show(+c.value));
	for (let e of [
		s,
		c,
		u
	]) e.hidden = n.count < 2;
	return {
		playing: (e) => s.textContent = e ? "❚❚" : "▶",
		update(e, r) {
			let { sentence: i } = t.statuses[n.mark];
			p.textContent !== i && (p.textContent = i), c.value = String(e), u.textContent = t.drives.map((t) => `${t.name} = ${K(n.position(t.name, e) / t.size, 5)}${t.unit === "°" ? "" : " "}${t.unit}`).join(", "), [d.disabled, f.disabled] = r.map((e) => !e);
		}
	};
}
// src/tools.ts
var Ce = class {
	b;
	data;
	kernel;
	on = !1;
	arrows;
	constructor(e, t, n) {
		this.b = e, this.data = t, this.kernel = n;
		let r = c("g", e.svg, { class: "gradient" }), i = t.gradient ? t.handles.flatMap((e) => "ends" in e && e.ends.length ? [e] : []) : [];
		this.arrows = i.map((e) => ({
			p: e.p,
			ends: e.ends,
			arrow: new b(r, "acceleration", `lower the peak by ${e.name}`)
		}));
	}
	update(e) {
		let t = this.data.gradient, n = this.kernel, r = e && t ? t.curves.indexOf(e.row) : -1;
		if (!this.on || r < 0 || !t || !e || !n.solved) return this.arrows.forEach((e) => e.arrow.set([0, 0], [0, 0]));
		let i = (t) => Math.abs(n.value(e.row, t)), a = n.largest(i), o = Math.max(0, n.good.findIndex((e, t) => e > 0 && i(t) === a)), s = n.gradient(r, o), c = -Math.sign(n.value(e.row, o)) || 1, l = new Map(t.numbers.map((e, t) => [e, s[t]])), u = this.arrows.map(({ ends: e }) => {
			let t = this.b.paper.axes[0].map(() => 0);
			for (let r of e) r.axes.forEach((e, i) => e.forEach((e, a) => t[a] += c * n.here[e] * (l.get(r.n[i]) ?? 0)));
			return this.b.paper.project(t);
		}), d = Math.max(...u.map((e) => Math.hypot(...e)), 1e-300);
		this.arrows.forEach(({ p: e, arrow: t }, n) => {
			let [r, i] = this.b.paper.point(e), [a, o] = u[n];
			t.set([r, i], [r + 14 * a / d, i - 14 * o / d], .5);
		});
	}
}, we = class {
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
}, Te = class {
	kernel;
	past = [];
	future = [];
	now;
	constructor(e) {
		this.kernel = e, this.now = e.values.slice();
	}
	note() {
		this.now.every((e, t) => e === this.kernel.values[t]) || (this.past.push(this.now), this.past.length > 500 && this.past.shift(), this.future = [], this.now = this.kernel.values.slice());
	}
	go(e) {
		let t = e ? this.past : this.future, n = e ? this.future : this.past, r = t.pop();
		return r ? (n.push(this.now), this.now = r, this.kernel.values.set(r), !0) : !1;
	}
	get can() {
		return [this.past.length > 0, this.future.length > 0];
	}
};
function Ee(e, t) {
	return Object.fromEntries(e.numbers.flatMap((e, n) => t.values[n] === e.value ? [] : [[e.path, t.values[n]]]));
}
function Z(e, t, n) {
	e.numbers.forEach((e, r) => t.values[r] = Number.isFinite(n[e.path]) ? n[e.path] : e.value);
}
function De(e, t, n) {
	let r = new URLSearchParams({ t: String(+n.toFixed(4)) });
	for (let [n, i] of Object.entries(Ee(e, t))) r.set(n, String(i));
	return r.toString();
}
function Oe(e, t, n) {
	let r = new Map([...new URLSearchParams(n.replace(/^#/, ""))].map(([e, t]) => [e, t.trim() ? Number(t) : NaN])), i = r.get("t") ?? 0;
	return r.delete("t"), Z(e, t, Object.fromEntries(r)), Number.isFinite(i) ? Math.min(Math.max(i, 0), t.end) : 0;
}
function Q(e, t) {
	return e.template.map((e, n) => n % 2 ? String(t.values[+e]) : e).join("");
}
function ke(e, t) {
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
function Ae(e, t) {
	let n = e.cloneNode(!0), { width: r, height: i } = e.viewBox.baseVal;
	n.querySelectorAll(".handles").forEach((e) => e.remove()), s(n, {
		xmlns: "http://www.w3.org/2000/svg",
		width: `${r}mm`,
		height: `${i}mm`,
		"font-family": "'DejaVu Sans', Arial, sans-serif"
	});
	let a = c("style", null);
	return a.textContent = t, n.prepend(a), new XMLSerializer().serializeToString(n);
}
function $(e, t, n) {
	let r = document.createElement("a");
	r.href = URL.createObjectURL(new Blob([t], { type: n })), r.download = e, r.click(), setTimeout(() => URL.revokeObjectURL(r.href), 1e3);
}
var je = (e) => h(e).toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "").slice(0, 60) || "mechanism", Me = 170, Ne = 105, Pe = 6;
async function Fe(e, t, n = {}) {
	if (t.format !== "dalembert-page/1") throw Error(`this page cannot show data of the form ${t.format}`);
	let r = await a.create(t), i = document.createElement("div"), o = [], s = (e.clientWidth || window.innerWidth) < 560, c = s ? Ne : Me;
	i.className = "dalembert", i.tabIndex = -1;
	let u = `@media (prefers-color-scheme:dark){${t.style.dark}}@media print{${t.style.light}}`;
	l("style", i).textContent = pe + t.style.light + u, n.changes && Z(t, r, n.changes);
	let d = n.address ? Oe(t, r, location.hash) : 0, f = 0, p = !0, m = 0;
	r.cycle();
	let g = new Te(r), _ = t.views.charts.flatMap((e) => e.curves.map((n) => ({
		curve: n,
		unit: t.units[e.kind]
	}))), v = _.find((e) => t.gradient?.curves.includes(e.curve.row)), y = Se(i, t, r, {
		play: R,
		show: L,
		go: I,
		reset: F
	}), b = l("main", i), x = l("section", b, {
		class: "stage",
		"aria-label": "mechanism"
	}), S = t.views.mechanism, C = ne(x, r, S, null, c, te(r, S, c), t.units, "the mechanism"), w = new Ce(C, t, r), T = new we(x, C, t, r, t.handles.flatMap((e) => e.kind === "joint" || e.kind === "point" ? [e.p] : [])), E = le(C, t, r, {
		changed: () => B(!0),
		finished: P,
		seek: L,
		time: () => d
	}), D = l("section", b, {
		class: "side",
		"aria-label": "results"
	}), O = xe(D, t, r, {
		time: () => d,
		seek: L,
		pick: (e) => (v = _.find((t) => t.curve === e), B(!0)),
		picked: () => v?.curve
	}, () => B(!0), s), k = j(), A = me(X(D, "Change numbers", t.numbers.some((e) => e.parameter)), t, r, (e) => e ? P() : B(!0));
	ye(X(D, "Method and assumptions"), t), M(), C.svg.addEventListener("click", (e) => O.choose(e.target.closest("[data-link]")?.dataset.link));
	function j() {
		let e = l("div", x, { class: "switches" }), n = (t, n, r, i) => {
			let a = l("label", e, { title: n }), o = l("input", a, { type: "checkbox" });
			o.checked = r, a.append(t), o.addEventListener("change", () => (i(o.checked), B(!0)));
		};
		return n("names", "names of joints", C.names, (e) => C.names = e), t.gradient && n("what lowers the peak", "arrows: moving a joint this way lowers the peak of the chosen curve", !1, (e) => w.on = e), t.handles.some((e) => e.kind === "joint") && n("tolerances", "a thousand machines with points up to 0.5 % of the drawing's width off", !1, (e) => T.on = e), C.paper.axes.length > 2 && (l("span", e, {}, "drag to look from elsewhere"), Ie([C, ...O.bodies], () => B(!0))), l("span", e, { class: "spread" });
	}
	function M() {
		let e = X(D, "Save and share"), i = je(t.title), a = (t, n) => l("button", e, { type: "button" }, t).addEventListener("click", n);
		a("Model file", () => $(`${i}.yaml`, Q(t, r), "text/yaml")), a("Curves as CSV", () => $(`${i}.csv`, ke(t, r), "text/csv")), a("Drawing as SVG", () => $(`${i}.svg`, Ae(C.svg, t.style.light), "image/svg+xml")), a("Print", () => window.print()), n.address && a("Copy link", () => {
			location.hash = De(t, r, d), navigator.clipboard?.writeText(location.href);
		});
	}
	function N() {
		B(!0), A.update(), n.edited?.(Ee(t, r)), n.address && window.history.replaceState(null, "", "#" + De(t, r, d));
	}
	function P() {
		g.note(), C.fit(), N();
	}
	function F() {
		Z(t, r, {}), P();
	}
	function I(e) {
		g.go(e) && N();
	}
	function L(e) {
		d = Math.min(Math.max(e, 0), r.end), t.only_at_positions && (d = Math.round(d)), B(!1);
	}
	function R() {
		if (y.playing(!m), m) return z();
		let e = performance.now(), t = d, n = (i) => {
			t += (i - e) / 1e3 / Pe * r.end, e = i, t >= r.end && (t = 0), L(t), m = requestAnimationFrame(n);
		};
		m = requestAnimationFrame(n);
	}
	function z() {
		cancelAnimationFrame(m), m = 0;
	}
	function B(e) {
		p ||= e, f ||= requestAnimationFrame(() => {
			f = 0;
			let e = performance.now();
			V(), o.push(performance.now() - e), o.length > 2e3 && o.shift();
		});
	}
	function V() {
		let e = p;
		p = !1, e && r.cycle(), r.at(d), i.classList.toggle("unsolved", !r.solved), C.update(e), E(), w.update(v?.curve);
		let t = T.update(v?.curve.row);
		k.textContent = t && v ? `${h(v.curve.name)}: ${K(t.mean / v.unit.size)} ± ${K(t.sigma / v.unit.size, 2)} ${v.unit.unit} (1 σ)` : "", O.update(e), y.update(d, g.can);
	}
	return i.querySelectorAll("details").forEach((e) => e.addEventListener("toggle", () => B(!0))), i.addEventListener("keydown", (e) => {
		let t = /INPUT|SELECT|TEXTAREA/.test(e.target.tagName);
		(e.ctrlKey || e.metaKey) && !t && /^[zy]$/i.test(e.key) ? (e.preventDefault(), I(e.key.toLowerCase() === "z" && !e.shiftKey)) : e.key === " " && !t && e.target.tagName !== "BUTTON" && r.count > 1 && (e.preventDefault(), R());
	}), r.at(d), e.replaceChildren(i), C.fit(), V(), A.update(), {
		kernel: r,
		data: t,
		times: o,
		show: L,
		set(e) {
			Z(t, r, e), g.note(), C.fit(), B(!0), A.update();
		},
		text: () => Q(t, r),
		remove: () => (z(), i.remove())
	};
}
function Ie(e, t) {
	for (let n of e) n.svg.style.cursor = "move", n.svg.addEventListener("pointerdown", (e) => n.svg.setPointerCapture(e.pointerId)), n.svg.addEventListener("pointermove", (r) => {
		if (n.svg.hasPointerCapture(r.pointerId)) {
			for (let t of e) t.paper.turn(-.01 * r.movementX, .01 * r.movementY), t.fit();
			t();
		}
	});
}
// src/main.ts
async function Le(e, t) {
	try {
		return await Fe(e, JSON.parse(new TextDecoder().decode(await n(t))), { address: location.protocol !== "about:" });
	} catch (t) {
		throw e.textContent = String(t), t;
	}
}
var Re = { async render({ model: e, el: t }) {
	let n = "", r = (t) => {
		n = JSON.stringify(t), e.set("changes", t), e.save_changes();
	}, i = async () => {
		let n = await Fe(t, e.get("data"), {
			edited: r,
			changes: e.get("changes")
		});
		return l("style", t, {}, `[data-dalembert="${e.get("frame")}"]{display:none}`), n;
	}, a = await i(), o = async () => {
		a.remove(), a = await i();
	}, s = () => JSON.stringify(e.get("changes")) !== n && a.set(e.get("changes"));
	return e.on("change:data", o), e.on("change:changes", s), () => {
		e.off("change:data", o), e.off("change:changes", s), a.remove();
	};
} };
export { Re as default, Le as open };
