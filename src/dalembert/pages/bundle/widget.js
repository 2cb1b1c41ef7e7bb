function e(e, t, n = {}) {
	let r = document.createElementNS("http://www.w3.org/2000/svg", e);
	for (let [e, t] of Object.entries(n)) r.setAttribute(e, String(t));
	return t?.append(r), r;
}
function t(e, t, n = {}, r = "") {
	let i = document.createElement(e);
	for (let [e, t] of Object.entries(n)) i.setAttribute(e, String(t));
	return r && (i.textContent = r), t?.append(i), i;
}
function n(e) {
	let t = Math.round(100 * Math.abs(e)), n = Math.floor(t / 100), r = t % 100;
	return (e < 0 && t ? "-" : "") + n + (r ? (r < 10 ? ".0" : ".") + r : "");
}
function r(e, t = !1) {
	return e.length ? "M" + e.map(([e, t]) => n(e) + " " + n(t)).join("L") + (t ? "Z" : "") : "";
}
function i(e, t, r) {
	e.setAttribute("transform", `translate(${n(t)} ${n(r)})`);
}
function a(e, t) {
	let n = new DOMPoint(t.clientX, t.clientY).matrixTransform(e.getScreenCTM().inverse());
	return [n.x, n.y];
}
function o(t, n, r) {
	t.replaceChildren();
	let i = !1;
	for (let a of n.split(/(_\{[^}]*\})/)) {
		if (!a) continue;
		let n = a.startsWith("_{"), o = e("tspan", t, n ? { "font-size": .7 * r } : {});
		o.textContent = n ? a.slice(2, -1) : a, n !== i && o.setAttribute("dy", String((n ? .25 : -.25) * r)), i = n;
	}
}
var s = (e) => e.replace(/_\{([^}]*)\}/g, "$1"), c = null, l = /* @__PURE__ */ new Map();
function u(e, t, n = !1) {
	let r = `${n}${e}`, i = l.get(r);
	if (i === void 0) {
		c ??= document.createElement("canvas").getContext("2d"), c.font = `${n ? "bold " : ""}100px "DejaVu Sans", "Helvetica Neue", Arial, sans-serif`, i = 0;
		for (let t of e.split(/(_\{[^}]*\})/)) {
			let e = t.startsWith("_{");
			i += c.measureText(e ? t.slice(2, -1) : t).width / 100 * (e ? .7 : 1);
		}
		l.set(r, i);
	}
	return i * t;
}
function d(t, n, r, i, a = "middle") {
	let s = e("text", t, {
		class: `l-${n}-t`,
		"font-size": i,
		"text-anchor": a
	});
	return o(s, r, i), s;
}
var f = class {
	g;
	shaft;
	head;
	constructor(t, n, r = "") {
		this.g = e("g", t), r && (e("title", this.g).textContent = s(r)), this.shaft = e("path", this.g, {
			class: `l-${n}`,
			style: "fill:none"
		}), this.head = e("path", this.g, { class: `l-${n}-h` });
	}
	set(e, t, n = .3) {
		let i = t[0] - e[0], a = t[1] - e[1], o = Math.hypot(i, a), s = o > n && Number.isFinite(o);
		if (this.g.setAttribute("display", s ? "inline" : "none"), !s) return !1;
		let c = i / o, l = a / o, u = Math.min(3, .75 * o), d = .3 * u, f = [t[0] - u * c, t[1] - u * l];
		return this.shaft.setAttribute("d", r([e, [t[0] - .8 * u * c, t[1] - .8 * u * l]])), this.head.setAttribute("d", r([
			t,
			[f[0] - d * l, f[1] + d * c],
			[f[0] + d * l, f[1] - d * c]
		], !0)), !0;
	}
};
function p(e) {
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
var m = [
	[1, -1],
	[-1, -1],
	[1, 1],
	[-1, 1],
	[0, -1],
	[1, 0],
	[-1, 0],
	[0, 1]
], h = [
	1,
	1.9,
	3,
	4.5
];
function g(e, t, n, r) {
	return {
		el: d(e, t, n, r),
		text: n,
		size: r,
		bold: t === "title",
		choice: -1
	};
}
var _ = class {
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
		let t = e.label, n = u(t.text, t.size, t.bold) + .5, r = 1.1 * t.size + (t.text.includes("_") ? .3 * t.size : 0), a = e.leave ?? 1.2, o = e.away && Math.hypot(...e.away) || 1, s = Infinity, c = 0, l = [
			0,
			0,
			0,
			0
		], d = 0;
		for (let [i, u] of e.anchors) for (let f of h) for (let [p, h] of m) {
			let m = a * f, g = i + p * (m + n / 2), _ = u + h * (m + r / 2), v = [
				g - n / 2,
				_ - r / 2,
				g + n / 2,
				_ + r / 2
			], y = d % 32 * .12 + .2 * Math.floor(d / 32) - (d === t.choice ? .4 : 0);
			e.away && (y += 1.2 * (1 - (p * e.away[0] + h * e.away[1]) / (Math.hypot(p, h) * o))), y < s && (y += this.cost(v)) < s && (s = y, c = d, l = v), d++;
		}
		t.choice = c, this.texts.push(l), i(t.el, (l[0] + l[2]) / 2, l[1] + .91 * t.size);
	}
	cost(e) {
		let t = 0;
		for (let n of this.texts) v(e, n) > 0 && (t += 60 + 5 * v(e, n));
		for (let n of this.discs) v(e, n) > 0 && (t += 8 + v(e, n));
		for (let [n, r] of this.lines) y(e, n, r) && (t += 6);
		let [n, r, i, a] = this.bounds;
		return (e[0] < n || e[1] < r || e[2] > i || e[3] > a) && (t += 20), t;
	}
};
function v(e, t) {
	let n = Math.min(e[2], t[2]) - Math.max(e[0], t[0]), r = Math.min(e[3], t[3]) - Math.max(e[1], t[1]);
	return n > 0 && r > 0 ? n * r : 0;
}
function y(e, t, n) {
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
var b = (e, t, n) => t.reduce((t, r, i) => t + e[i] * n(r), 0), x = class {
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
		return e.length < 3 ? [t(e[0]), t(e[1])] : [b(this.axes[0], e, t), b(this.axes[1], e, t)];
	}
	depth(e) {
		return b(this.axes[2], e, (e) => this.kernel.here[e]);
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
function S(t, i, a) {
	let o = a.kernel.here;
	if (i.t === "symbol") {
		let r = e("g", t, i.per_mm ? { class: "span" } : {});
		return r.innerHTML = i.svg, {
			update() {
				let [e, t] = a.point(i.p), s = i.per_mm ? ` scale(${(i.per_mm / a.perMm).toFixed(4)})` : "", c = i.e ? ` rotate(${n(-Math.atan2(o[i.e[1]], o[i.e[0]]) * 180 / Math.PI)})` : "";
				r.setAttribute("transform", `translate(${n(e)} ${n(t)})${c}${s}`);
			},
			mark: (e) => e.disc(a.point(i.p), 1.6)
		};
	}
	if (i.t === "span") {
		let r = e("g", t, { class: "span" });
		return r.innerHTML = i.svg, {
			update() {
				let [[e, t], [o, s]] = i.p.map((e) => a.point(e)), c = Math.hypot(o - e, s - t), l = Math.atan2(s - t, o - e) * 180 / Math.PI;
				r.setAttribute("transform", `translate(${n(e)} ${n(t)}) rotate(${n(l)}) scale(${(c / i.length).toFixed(4)} 1)`);
			},
			mark: (e) => e.line(a.point(i.p[0]), a.point(i.p[1]))
		};
	}
	if (i.t === "circle") {
		let r = e("circle", t, { class: `l-${i.role}` });
		return { update() {
			let [e, t] = a.point(i.p);
			r.setAttribute("cx", n(e)), r.setAttribute("cy", n(t)), r.setAttribute("r", n(Math.abs(o[i.r]) / a.perMm));
		} };
	}
	if (i.t === "pair") return C(t, i, a);
	let s = e("path", t, {
		class: `l-${i.role}`,
		style: "fill:none"
	});
	if (i.t === "trace") return { update: () => s.setAttribute("d", w(a.kernel, (e) => a.pointAt(i.p[0], e), !0)) };
	i.t === "hull" && (s.dataset.link = i.link);
	let c = [], l = !1;
	return {
		update() {
			let e = i.p.map((e) => a.point(e)), t = i.t === "hull" ? p(e) : e;
			l = i.t === "hull" && t.length > 2, c = l ? t : e, i.t === "hull" && s.setAttribute("class", l ? "l-link-area" : "l-link"), s.style.fill = l ? "" : "none", s.setAttribute("d", r(c, l));
		},
		mark(e) {
			c.forEach((t, n) => (n || l) && e.line(c.at(n - 1), t));
		}
	};
}
function C(t, r, i) {
	let a = e("g", t), o = r.fixed ? "support" : "block", s = e("path", a, { class: `l-${o}` }), c = e("path", a, { class: `l-${r.shape === "ball" ? o : "pin"}` }), l = r.shape === "block" ? 4.2 : 3.4, u = r.shape === "block" ? 2.2 : 1.7;
	return {
		update() {
			let [e, t] = i.point(r.p), [o, d] = i.here(r.e), f = i.depth(r.e);
			if (a.setAttribute("transform", `translate(${n(e)} ${n(t)}) rotate(${n(-Math.atan2(d, o) * 180 / Math.PI)})`), r.shape === "ball") return s.setAttribute("d", `M${u} 0A${u} ${u} 0 1 0 ${-u} 0A${u} ${u} 0 1 0 ${u} 0Z`);
			let p = l * Math.hypot(o, d), m = u * Math.abs(f), h = f >= 0 ? p : -p;
			r.shape === "round" ? (s.setAttribute("d", `M${n(-p)} ${-u}L${n(p)} ${-u}A${n(m)} ${u} 0 0 1 ${n(p)} ${u}L${n(-p)} ${u}A${n(m)} ${u} 0 0 1 ${n(-p)} ${-u}Z`), c.setAttribute("d", `M${n(h + m)} 0A${n(m)} ${u} 0 1 0 ${n(h - m)} 0A${n(m)} ${u} 0 1 0 ${n(h + m)} 0Z`)) : (s.setAttribute("d", `M${n(-p - m)} ${-u}H${n(p + m)}V${u}H${n(-p - m)}Z`), c.setAttribute("d", `M${n(h - m)} ${-u}H${n(h + m)}V${u}H${n(h - m)}Z`));
		},
		mark: (e) => e.disc(i.point(r.p), 2.4)
	};
}
function w(e, t, r = !1) {
	let i = r && e.cyclic ? e.count : e.count - 1, a = "", o = !1;
	for (let r = 0; r <= i; r++) {
		let i = r % e.count, s = !!e.good[i];
		if (s) {
			let [e, r] = t(i);
			a += (o ? "L" : "M") + n(e) + " " + n(r);
		}
		o = s;
	}
	return a;
}
function T(e, t, n, r, i) {
	return t.t === "couple" ? k(e, t, n) : D(e, t, n, r, i);
}
var E = 13;
function D(e, t, n, r, i) {
	let a = new f(e, t.role, t.name), o = t.t === "force" ? null : new f(e, t.role), s = t.t === "force" ? t.f : t.m, c = g(e, t.role, t.name, 3.4), l = [0, 0], u = [0, 0], d = [0, 0], p = !1;
	return {
		label: c,
		update() {
			let e = n.point(t.p), [f, m] = n.here(s), h = o ? Math.hypot(...s.map((e) => n.kernel.here[e])) / E || 1 : r(), g = [f / h, -m / h], _ = !1;
			if (i && i.length > 1 && !o) {
				let t = i.map((e) => n.point(e)), r = [0, 1].map((e) => t.reduce((t, n) => t + n[e], 0) / t.length);
				_ = g[0] * (r[0] - e[0]) + g[1] * (r[1] - e[1]) > 1e-9;
			}
			[l, u] = _ ? [[e[0] - g[0], e[1] - g[1]], e] : [e, [e[0] + g[0], e[1] + g[1]]], d = _ ? l : u, p = a.set(l, u), o?.set(l, [l[0] + .78 * (u[0] - l[0]), l[1] + .78 * (u[1] - l[1])]), c.el.setAttribute("visibility", p ? "visible" : "hidden");
		},
		mark: (e) => p && e.line(l, u),
		anchor() {
			if (!p) return null;
			let e = d === l ? u : l, t = [d[0] - e[0], d[1] - e[1]];
			return [
				d,
				[d[0] - .35 * t[0], d[1] - .35 * t[1]],
				t
			];
		}
	};
}
var O = 4.6;
function k(t, r, i) {
	let a = i.kernel.here, o = e("g", t), c = g(t, r.role, r.name, 3.4);
	e("title", o).textContent = s(r.name), e("path", o, {
		class: `l-${r.role}`,
		style: "fill:none",
		d: "M4.17 1.94A4.6 4.6 0 1 0 -4.17 1.94"
	}), e("path", o, {
		class: `l-${r.role}-h`,
		d: "M-4.17 2.9L-5.6 -0.1L-3 0.3Z"
	});
	let l = !1;
	return {
		label: c,
		update() {
			let [e, t] = i.point(r.p), s = a[r.m[0]];
			l = Number.isFinite(s) && Math.abs(s) > 1e-9, o.setAttribute("display", l ? "inline" : "none"), c.el.setAttribute("visibility", l ? "visible" : "hidden"), o.setAttribute("transform", `translate(${n(e)} ${n(t)}) scale(${s < 0 ? -1 : 1} 1)`);
		},
		mark(e) {
			l && e.disc(i.point(r.p), O * .7);
		},
		anchor() {
			let [e, t] = i.point(r.p);
			return l ? [[e, t - O], [0, -1]] : null;
		}
	};
}
// src/board.ts
var A = [
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
function j(e) {
	if (!(e > 0) || !Number.isFinite(e)) return 1;
	let t = 10 ** Math.floor(Math.log10(e) + 1e-12);
	return t * (A.find((n) => n * t >= e * (1 - 1e-12)) ?? 10);
}
function M(e) {
	let t = (e) => [Math.min(...e), Math.max(...e)], n = t(e.map((e) => e[0])), r = t(e.map((e) => e[1]));
	return Number.isFinite(n[0] + n[1] + r[0] + r[1]) ? {
		x: n,
		y: r
	} : null;
}
var N = (e) => e.t === "hull" || e.t === "path" ? e.p : e.t === "symbol" || e.t === "pair" ? [e.p] : [];
function P(e, t) {
	let n = e.kernel, r = Math.max(1, Math.floor(n.count / 72)), i = [];
	for (let a of t.items.flatMap(N)) for (let t = 0; t < n.count; t += r) n.good[t] && i.push(e.seen(a, (e) => n.value(e, t)));
	return M(i);
}
var F = (e) => e.items.some((e) => e.t === "pair");
function I(e, t, n) {
	let r = P(new x(e, 1, F(t)), t), i = r ? (r.y[1] - r.y[0]) / (r.x[1] - r.x[0]) : NaN;
	return Number.isFinite(i) ? Math.min(Math.max(n * i * 1.05, 96), 150) : 120;
}
function L(t, n, r, i) {
	return e("svg", t, {
		viewBox: `${-n / 2} ${-r / 2} ${n} ${r}`,
		role: "group",
		"aria-label": i
	});
}
function ee(t, n, r, i, a, o, s, c) {
	let l = {
		length: s.length.size,
		force: s.force.size
	}, u = L(t, a, o, c), d = new x(n, r.per_mm, F(r)), f = [], p = [], m = r.force;
	r.middle && (d.middle = r.middle);
	let h = e("g", u), v = e("g", u), y = e("g", u);
	for (let e of r.items) (e.t === "trace" ? f : p).push(S(h, e, d));
	let b = r.arrows.map((e) => T(v, e, d, () => m, i ?? void 0)), C = r.labels.map((e) => ({
		l: g(y, e.role, e.text, e.kind === "joint" ? 3.8 : 3.3),
		p: e.p,
		q: e.q
	})), w = e("text", y, {
		class: "l-note-t",
		"font-size": 2.8,
		x: -a / 2 + 2,
		y: o / 2 - 2
	});
	function E(e) {
		e && (d.middle = [(e.x[0] + e.x[1]) / 2, (e.y[0] + e.y[1]) / 2]);
	}
	function D() {
		let e = i ? M(i.map((e) => d.here(e))) : P(d, r);
		if (e) {
			let t = i ? [46, 40] : [a * .76, o * .74], n = Math.max((e.x[1] - e.x[0]) / t[0], (e.y[1] - e.y[0]) / t[1]) || r.per_mm;
			E(e), d.perMm = j(n / l.length) * l.length;
		}
		let t = Math.max(0, ...r.arrows.map((e) => e.t === "force" ? n.largest((t) => Math.hypot(...e.f.map((e) => n.value(e, t)))) : 0));
		t > 0 && (m = j(t / (i ? 26 : 22) / l.force) * l.force);
	}
	function O() {
		let e = new _([
			-a / 2,
			-o / 2,
			a / 2,
			o / 2 - 4
		]);
		for (let t of [...p, ...b]) t.mark?.(e);
		for (let { l: t, p: n, q: r } of C) {
			let i = k.names || !!r;
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
		for (let t of b) {
			let r = n.solved ? t.anchor() : null;
			r ? e.put({
				label: t.label,
				anchors: r.slice(0, -1),
				away: r[r.length - 1],
				leave: .9
			}) : t.label.el.setAttribute("visibility", "hidden");
		}
	}
	let k = {
		svg: u,
		paper: d,
		fit: D,
		force: () => m,
		names: r.labels.filter((e) => e.kind === "joint").length <= 8,
		update(e) {
			if (e && f.forEach((e) => e.update()), v.setAttribute("visibility", n.solved ? "visible" : "hidden"), n.finite) {
				i && E(M(i.map((e) => d.here(e))));
				for (let e of [...p, ...b]) e.update();
				O(), w.textContent = `1 mm = ${+(d.perMm / l.length).toPrecision(4)} ${s.length.unit}, ${+(m / l.force).toPrecision(4)} ${s.force.unit}`;
			}
		}
	};
	return k;
}
// src/charts.ts
var R = 120, z = 5, te = 8, B = 4;
function V(e, t) {
	let n = e / t || 1, r = 10 ** Math.floor(Math.log10(n));
	return r * ([
		1,
		2,
		5,
		10
	].find((e) => e * r >= n) ?? 10);
}
function H(e, t, n) {
	let r = Math.ceil(e / n - 1e-9), i = Math.floor(t / n + 1e-9) - r + 1;
	return Array.from({ length: Math.max(i, 0) }, (e, t) => (r + t) * n);
}
var U = (e, t = 4) => Number.isFinite(e) ? String(+e.toPrecision(t)).replace("-", "−") : "–";
function ne(r, i, s, c, l) {
	let d = t("figure", r, { class: "chart" }), f = i.units[c.kind];
	t("figcaption", d, {}, `${c.title}, ${f.unit}`);
	let p = Math.min(Math.max(...c.curves.map((e) => u(e.name, 3))) + 4, 36), m = Math.max(52, 13 + B * c.curves.length), h = L(d, R, m, c.title), g = 104 - p, _ = m - z - te, v = -m / 2 + z, y = e("path", h, {
		class: "l-grid",
		style: "fill:none"
	}), b = e("path", h, {
		class: "l-axis",
		style: "fill:none"
	}), x = e("g", h), S = c.curves.map((t) => e("path", h, {
		class: `l-${t.role}`,
		style: "fill:none"
	})), C = e("path", h, { class: "cursor" }), T = c.curves.map((t) => e("circle", h, {
		class: `l-${t.role}-h`,
		r: .9
	})), E = Math.max(s.count - 1, 1), D = i.noise[c.kind] ?? 0, O = c.curves.map((t, n) => {
		let r = e("text", h, {
			class: `l-${t.role}-t key`,
			"font-size": 3,
			x: -44 + g + 2,
			y: v + 3 + B * n,
			tabindex: 0,
			role: "button"
		});
		return o(r, t.name, 3), e("title", r).textContent = "show what lowers its peak", r.addEventListener("click", () => l.pick(t)), r.addEventListener("keydown", (e) => e.key === "Enter" && l.pick(t)), r;
	}), k = (e, t) => {
		let n = s.value(e.row, t) / f.size;
		return Math.abs(n) * f.size < D ? 0 : n;
	}, A = NaN, j = NaN, M = (e) => -44 + e / E * g, N = (e) => v + _ - (e - A) / (j - A) * _;
	function P() {
		let [e, t] = [Infinity, -Infinity];
		for (let n of c.curves) for (let r = 0; r < s.count; r++) if (s.good[r]) {
			let i = k(n, r);
			e = Math.min(e, i), t = Math.max(t, i);
		}
		e <= t || ([e, t] = [0, 1]), e > 0 && e < .4 * t && (e = 0), t < 0 && t > .4 * e && (t = 0), t - e < 1e-9 * Math.max(Math.abs(t), Math.abs(e), 1e-9) && ([e, t] = [Math.min(e, 0), Math.max(t, 0) || 1]);
		let n = V(t - e, 4);
		return [e, t] = [Math.floor(e / n + 1e-9) * n, Math.ceil(t / n - 1e-9) * n], e === A && t === j ? !1 : ([A, j] = [e, t], !0);
	}
	function F() {
		let t = i.drives[0], r = V(j - A, 4), a = (t, n, r, i) => e("text", x, {
			class: "l-note-t",
			"font-size": 2.6,
			"text-anchor": i,
			x: n,
			y: r
		}).textContent = t;
		x.replaceChildren();
		let o = "";
		for (let e of H(A, j, r)) o += `M-44 ${n(N(e))}h${g}`, a(U(e, 5), -45.2, N(e) + .9, "end");
		if (t) {
			let [e, r] = [0, E].map((e) => s.position(t.name, e) / t.size);
			for (let i of H(Math.min(e, r), Math.max(e, r), V(Math.abs(r - e), 5))) {
				let s = -44 + (i - e) / (r - e || 1) * g;
				o += `M${n(s)} ${v}v${_}`, a(U(i, 5) + (t.unit === "°" ? "°" : ""), s, v + _ + 3.4, "middle");
			}
			a(`${t.name}, ${t.unit}`, -44 + g, v + _ + 6.6, "end");
		}
		y.setAttribute("d", o), b.setAttribute("d", `M-44 ${v}v${_}` + (A < 0 && j > 0 ? `M-44 ${n(N(0))}h${g}` : ""));
	}
	let I = (e) => l.seek((a(h, e)[0] - -44) / g * E);
	return h.addEventListener("pointerdown", (e) => {
		e.target.closest(".key") || (h.setPointerCapture(e.pointerId), I(e));
	}), h.addEventListener("pointermove", (e) => e.buttons && h.hasPointerCapture(e.pointerId) && I(e)), { update(e) {
		e && (P() && F(), S.forEach((e, t) => e.setAttribute("d", w(s, (e) => [M(e), N(k(c.curves[t], e))]))));
		let t = n(M(Math.min(l.time(), E)));
		C.setAttribute("d", `M${t} ${v}v${_}`), c.curves.forEach((e, r) => {
			T[r].setAttribute("visibility", s.solved ? "visible" : "hidden"), s.solved && (T[r].setAttribute("cx", t), T[r].setAttribute("cy", n(N(s.here[e.row] / f.size)))), O[r].classList.toggle("picked", l.picked() === e);
		});
	} };
}
function re(n, r, i, a) {
	let o = t("figure", n, { class: "polar" }), [s, c] = i.f, l = t("figcaption", o), u = L(o, 66, 66, `polar diagram of joint ${i.name}`);
	e("path", u, {
		class: "l-grid",
		style: "fill:none",
		d: "M-30 0H30M0 -30V30M15 0A15 15 0 1 0 -15 0A15 15 0 1 0 15 0M30 0A30 30 0 1 0 -30 0A30 30 0 1 0 30 0"
	});
	let d = e("path", u, {
		class: `l-${i.role}`,
		style: "fill:none"
	}), p = new f(u, "joint-force", i.name), m = 1;
	return { update(e) {
		e && (m = j(r.largest((e) => Math.hypot(r.value(s, e), r.value(c, e))) / 28 / a.size) * a.size, d.setAttribute("d", w(r, (e) => [r.value(s, e) / m, -r.value(c, e) / m], !0)), l.textContent = `Joint ${i.name}: 1 mm = ${U(m / a.size)} ${a.unit}`), p.set([0, 0], r.solved ? [r.here[s] / m, -r.here[c] / m] : [0, 0]);
	} };
}
function ie(n, i, a, o, s) {
	let c = t("figure", n, { class: "polygon" }), l = i.units.force;
	t("figcaption", c, {}, o);
	let u = L(c, 110, 80, o), d = e("g", u), p = /* @__PURE__ */ new Set(), m = s.map(({ sides: e }) => {
		let t = e.find((e) => e.kind === "joint" && p.has(e.of));
		for (let t of e) t.kind === "joint" && p.add(t.of);
		return {
			shared: t,
			drawn: e.filter((e) => e !== t).map((e) => ({
				s: e,
				arrow: new f(u, e.role, e.name),
				name: g(d, e.role, e.name, 3)
			}))
		};
	}), h = e("path", u, {
		class: "l-gap",
		style: "fill:none"
	}), v = e("text", u, {
		class: "l-note-t",
		"font-size": 2.8,
		x: -53,
		y: 38
	});
	return {
		figure: c,
		update() {
			if (u.setAttribute("visibility", a.solved ? "visible" : "hidden"), !a.solved) return;
			let e = a.here, t = /* @__PURE__ */ new Map(), n = [], i = [], o = m.flatMap(({ shared: r, drawn: a }) => {
				let o = M(n)?.y[1] ?? 0, s = t.get(r?.of ?? "") ?? [0, o], c = (t) => [s[0] + e[t[0]], s[1] - e[t[1]]], l = s;
				r && (s = c(r.f));
				let u = a.map((e) => {
					let r = s;
					return s = c(e.s.f), e.s.kind === "joint" && !t.has(e.s.of) && t.set(e.s.of, s), n.push(r, s), {
						...e,
						from: r,
						to: s
					};
				});
				return i.push([l, s]), u;
			}), s = M(n) ?? {
				x: [0, 0],
				y: [0, 0]
			}, c = j(Math.max((s.x[1] - s.x[0]) / 66, (s.y[1] - s.y[0]) / 48) / l.size) * l.size, d = ([e, t]) => [(e - (s.x[0] + s.x[1]) / 2) / c, (t - (s.y[0] + s.y[1]) / 2) / c], f = new _([
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
			h.setAttribute("d", i.map(([e, t]) => r([d(e), d(t)])).join("")), v.textContent = `1 mm = ${U(c / l.size)} ${l.unit}`;
		}
	};
}
// src/handles.ts
function ae(t, n, r, i) {
	let a = e("g", t.svg, { class: "handles" }), o = n.handles.map((e) => se(a, t, e, r, i));
	return ce(t, n, r, i), () => r.finite && o.forEach((e) => e());
}
var W = (e, t) => e.reduce((e, n, r) => e + n * t[r], 0);
function oe(e, t, n, r, [i, a]) {
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
function se(t, r, i, o, s) {
	let c = `${{
		joint: "joint",
		point: "point",
		center: "",
		load: "force",
		direction: "direction of"
	}[i.kind]} ${i.name}`.trim(), l = e("circle", t, {
		class: `handle ${i.kind}`,
		r: i.kind === "joint" ? 2.6 : 2,
		tabindex: 0,
		role: "slider",
		"aria-label": `move ${c}`,
		"aria-valuetext": c,
		"aria-valuenow": 0,
		"data-kind": i.kind,
		"data-name": i.name
	});
	e("title", l).textContent = `drag ${c}`;
	let u = r.paper, d = o.values, f = (e) => e.map((e) => o.here[e]), p = [], m = [], h = [0, 0], g = [], _ = [0, 0], v = !1, y = () => {
		let e = u.point(i.p), t = "f" in i ? u.here(i.f) : "along" in i ? u.here(i.along) : [0, 0], n = i.kind === "direction" ? 16 : 1 / r.force();
		return [e[0] + n * t[0], e[1] - n * t[1]];
	}, b = () => {
		let e = (e, t) => ({
			axes: e.map(f),
			at: f(t)
		});
		p = "ends" in i ? i.ends.map((t) => e(t.axes, t.at)) : [e(i.axes, i.p)], [m, h, g, v] = [
			f(i.p),
			y(),
			"f" in i ? f(i.f) : [],
			!0
		];
	}, x = (e) => u.vector([e[0] - h[0], e[1] - h[1]]), S = (e) => {
		if ("by" in i && i.by) oe(o, u, i.p, i.by, u.metres(e));
		else if ("ends" in i) C(i.ends, x(e));
		else if (i.kind === "direction") {
			let t = u.point(i.p), n = [e[0] - t[0], t[1] - e[1]], [r, a] = p[0].axes.map((e) => W(e, n));
			d[i.direction] = G(Math.atan2(a, r), d[i.direction]);
		} else w(i, x(e).map((e, t) => g[t] + e / u.perMm * r.force()));
		s.changed();
	}, C = (e, t) => e.forEach((e, n) => {
		let r = m.map((e, r) => e + t[r] - p[n].at[r]);
		e.n.forEach((e, t) => d[e] = W(p[n].axes[t], r));
	}), w = (e, t) => {
		let n = p[0].axes.map((e) => W(e, t));
		if (e.components) return e.components.forEach((e, t) => d[e] = n[t]);
		let r = Math.sign(d[e.size]) || 1;
		e.direction === void 0 ? d[e.size] = r * W(t, g) / (Math.hypot(...g) || 1) : (d[e.direction] = G(Math.atan2(r * n[1], r * n[0]), d[e.direction]), d[e.size] = r * Math.hypot(...n));
	}, T = () => {
		v && s.finished(), v = !1;
	};
	return l.addEventListener("pointerdown", (e) => {
		e.stopPropagation(), l.setPointerCapture(e.pointerId), b();
		let t = a(r.svg, e);
		_ = [h[0] - t[0], h[1] - t[1]];
	}), l.addEventListener("pointermove", (e) => {
		let t = a(r.svg, e);
		v && S([t[0] + _[0], t[1] + _[1]]);
	}), l.addEventListener("pointerup", T), l.addEventListener("pointercancel", T), l.addEventListener("keydown", (e) => {
		let t = {
			ArrowLeft: [-1, 0],
			ArrowRight: [1, 0],
			ArrowUp: [0, -1],
			ArrowDown: [0, 1]
		};
		if (!t[e.key]) return;
		e.preventDefault(), e.stopPropagation(), b();
		let n = e.shiftKey ? 5 : 1;
		S([h[0] + n * t[e.key][0], h[1] + n * t[e.key][1]]), T();
	}), () => {
		if (i.kind === "direction" && v) return;
		let [e, t] = y();
		l.setAttribute("visibility", Number.isFinite(e + t) ? "visible" : "hidden"), l.setAttribute("cx", n(e)), l.setAttribute("cy", n(t));
	};
}
var G = (e, t) => e - 2 * Math.PI * Math.round((e - t) / (2 * Math.PI));
function ce(e, t, n, r) {
	let i = t.drives[0];
	if (!i || n.count < 2 || !(i.turns || i.along) || i.p.length > 2) return;
	let o = 0, s = 0, c = !1, l = (t) => {
		let n = a(e.svg, t), r = e.paper.point(i.p);
		return i.along ? W(e.paper.metres(n), e.paper.here(i.along)) : Math.atan2(r[1] - n[1], n[0] - r[0]);
	};
	e.svg.addEventListener("pointerdown", (t) => {
		t.target.closest("[data-link]")?.dataset.link === i.link && (e.svg.setPointerCapture(t.pointerId), [o, s, c] = [
			l(t),
			r.time(),
			!0
		]);
	}), e.svg.addEventListener("pointermove", (e) => {
		if (!c) return;
		let t = (n.position(i.name, n.count - 1) - n.position(i.name, 0)) / (n.count - 1), a = l(e), u = s + (i.turns ? G(a - o, 0) : a - o) / t;
		n.cyclic && (u = (u % n.count + n.count) % n.count), [o, s] = [a, u], r.seek(u);
	}), e.svg.addEventListener("pointerup", () => c = !1);
}
// src/kernel.ts
function K(e) {
	return Uint8Array.from(atob(e), (e) => e.charCodeAt(0));
}
function q(e) {
	if (typeof e == "string") return new Float64Array(K(e).buffer);
	let t = (e.to - e.from) / Math.max(e.count - 1, 1);
	return Float64Array.from({ length: e.count }, (n, r) => r === e.count - 1 ? e.to : e.from + r * t);
}
async function le(e) {
	let t = new Blob([K(e)]).stream().pipeThrough(new DecompressionStream("deflate"));
	return new Response(t).arrayBuffer();
}
var J = class e {
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
	static async create(t, n) {
		let { instance: r } = await WebAssembly.instantiate(await le(t.wasm)), { memory: i, run: a } = r.exports;
		return new e(a, i, t, n);
	}
	call(e) {
		this.run(this.places[0], this.places[1], this.places[2], Math.ceil(e / 2));
	}
}, ue = class {
	table;
	breaks;
	pieces;
	constructor(e) {
		this.table = e, this.breaks = q(e.breaks), this.pieces = q(e.pieces);
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
}, de = class e {
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
	constructor(e, t, n, r) {
		this.data = e, this.whole = t, this.one = n, this.slope = r, this.count = e.kernel.count, this.row = e.kernel.row, this.values = t.values, this.values.set(e.numbers.map((e) => e.value)), this.rows = t.out, this.good = new Uint8Array(this.count), this.here = new Float64Array(e.kernel.outputs + 1), this.positions = new Map(e.drives.map((e) => [e.name, q(e.position)])), this.channels = new Map(e.channels.map((e) => [e.name, {
			values: q(e.values),
			pieces: e.table && new ue(e.table),
			drive: e.table ? e.table.drive : e.name.replace(/^position /, "")
		}])), e.kernel.channels.forEach((e, n) => {
			let r = this.channels.get(e).values;
			for (let e = 0; e < this.row; e++) t.path[n * this.row + e] = r[Math.min(e, this.count - 1)];
		}), this.cyclic = !e.only_at_positions && e.drives.some((e) => e.turns && this.closes(e.name));
	}
	static async create(t) {
		let n = t.numbers.length, [r, i, a] = await Promise.all([
			J.create(t.kernel, n),
			J.create(t.kernel, n),
			t.gradient ? J.create(t.gradient, n) : void 0
		]);
		return new e(t, r, i, a);
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
}, fe = ".dalembert{--ink:#1d2733;--grey:#5b6672;--paper:#fff;--soft:#f4f6f8;--rim:#d5dbe1;--warn:#b3261e;--accent:#1c56a8;color:var(--ink);background:var(--paper);outline:none;font:15px/1.45 system-ui,DejaVu Sans,sans-serif}.dalembert *{box-sizing:border-box}.dalembert [hidden]{display:none!important}.dalembert header{z-index:2;background:var(--paper);border-bottom:1px solid var(--rim);padding:.35em .8em;position:sticky;top:0}.dalembert h1{margin:0;font-size:1.15em;display:inline}.dalembert .bar{flex-wrap:wrap;align-items:center;gap:.5em;margin-top:.25em;display:flex}.dalembert .bar input{min-width:8em;accent-color:var(--accent);flex:1}.dalembert .readout{font-variant-numeric:tabular-nums;min-width:9em}.dalembert button{font:inherit;color:inherit;background:var(--soft);border:1px solid var(--rim);cursor:pointer;border-radius:.4em;padding:.15em .6em}.dalembert button:disabled{opacity:.4;cursor:default}.dalembert .mark{color:var(--warn);min-height:1.45em;margin:.1em 0 0;font-size:.92em}.dalembert main{grid-template-columns:minmax(0,7fr) minmax(0,5fr);align-items:start;gap:.8em;padding:.8em;display:grid}.dalembert .stage{position:sticky;top:6.2em}.dalembert svg{touch-action:pan-y;-webkit-user-select:none;user-select:none;width:100%;height:auto;font-family:DejaVu Sans,Helvetica Neue,Arial,sans-serif;display:block;overflow:hidden}.dalembert .stage svg{touch-action:none;max-height:calc(100vh - 9em)}.dalembert .cloud{pointer-events:none;width:100%;position:absolute;top:0;left:0}.dalembert .switches{color:var(--grey);flex-wrap:wrap;gap:1em;font-size:.9em;display:flex}.dalembert .switches label{cursor:pointer;align-items:center;gap:.3em;display:flex}.dalembert figure{margin:0 0 .4em}.dalembert figcaption{color:var(--grey);font-size:.85em}.dalembert .panel{border-top:1px solid var(--rim);padding:.3em 0}.dalembert summary{cursor:pointer;padding:.15em 0;font-weight:600}.dalembert select{font:inherit;color:inherit;background:var(--soft);border:1px solid var(--rim);border-radius:.4em;max-width:100%}.dalembert .equation{font-variant-numeric:tabular-nums;overflow-wrap:anywhere;margin:.15em 0;font-size:.85em}.dalembert .answers{border-collapse:collapse;font-variant-numeric:tabular-nums;width:100%;font-size:.85em}.dalembert .answers th{text-align:left;padding:.1em .6em .1em 0;font-weight:400}.dalembert .answers td{text-align:right}.dalembert .answers tr+tr>*{border-top:1px solid var(--soft)}.dalembert .polar{width:49%;display:inline-block}.dalembert fieldset{border:0;border-top:1px solid var(--soft);margin:0;padding:.2em 0;font-size:.88em}.dalembert legend{padding:0 .4em 0 0;font-weight:600}.dalembert fieldset label{grid-template-columns:minmax(0,1fr) 7.5em 4.5em;align-items:center;gap:.4em;margin:.1em 0;display:grid}.dalembert fieldset label input[type=range]{accent-color:var(--accent);grid-column:1/-1}.dalembert fieldset input[type=number]{font:inherit;color:inherit;background:var(--soft);border:1px solid var(--rim);border-radius:.3em;width:100%;padding:.05em .3em}.dalembert input.changed{border-color:var(--accent);font-weight:600}.dalembert .unit{color:var(--grey)}.dalembert dl{grid-template-columns:auto 1fr;gap:.1em .8em;font-size:.9em;display:grid}.dalembert dd{margin:0}.dalembert .handle{fill:var(--accent);fill-opacity:.1;stroke:var(--accent);stroke-opacity:.35;stroke-width:.25px;cursor:grab;outline:none}.dalembert .handle:hover,.dalembert .handle:focus-visible{fill-opacity:.3;stroke-opacity:1;outline:none}.dalembert .handle.center{fill:#1a7f4b;stroke:#1a7f4b}.dalembert .handle.load{fill:#c1272d;stroke:#c1272d}.dalembert .handle.direction{fill:#7a2fa0;stroke:#7a2fa0}.dalembert .span *{vector-effect:non-scaling-stroke}.dalembert .cursor{stroke:var(--grey);stroke-width:.3px;fill:none}.dalembert .key{cursor:pointer}.dalembert .key.picked{text-decoration:underline}.dalembert .chart svg{cursor:crosshair}.dalembert [data-link]{cursor:pointer}.dalembert.unsolved svg:not(.chart svg){opacity:.3}@media (max-width:800px){.dalembert main{grid-template-columns:minmax(0,1fr)}.dalembert .stage{position:static}.dalembert .polar{width:100%}}@media (prefers-color-scheme:dark){.dalembert{--ink:#e8edf2;--grey:#9aa7b4;--paper:#151b22;--soft:#222b35;--rim:#323d48;--warn:#ff7b74;--accent:#6fa8f5}}@media print{.dalembert{--ink:#000;--grey:#444;--paper:#fff;--soft:#fff;--rim:#999;--accent:#000}.dalembert header,.dalembert .stage{position:static}.dalembert .bar,.dalembert .switches,.dalembert .handles,.dalembert summary~div>button,.dalembert select{display:none}.dalembert main{display:block}.dalembert figure,.dalembert .panel{break-inside:avoid}}";
// src/panels.ts
function Y(e, n, r = !1) {
	let i = t("details", e, { class: "panel" });
	return i.open = r, t("summary", i, {}, n), t("div", i);
}
function pe(e, n, r, i) {
	let a = [], o = /* @__PURE__ */ new Map(), s = (n) => {
		let r = o.get(n);
		if (!r) {
			let i = t("fieldset", e);
			t("legend", i, {}, n), o.set(n, r = i);
		}
		return r;
	}, c = n.numbers.map((e, t) => ({
		field: e,
		n: t
	})).sort((e, t) => Number(t.field.parameter ?? !1) - Number(e.field.parameter ?? !1));
	for (let { field: e, n } of c) {
		let [o, c] = e.parameter ? ["Parameters", e.label] : me(e.label), u = t("label", s(o), { title: e.about ?? e.path });
		t("span", u, {}, c);
		let d = t("input", u, {
			type: "number",
			step: "any",
			"aria-label": e.label,
			"data-path": e.path
		});
		t("span", u, { class: "unit" }, e.unit);
		let f = {
			box: d,
			n,
			field: e
		}, p = (t, a) => {
			Number.isFinite(t) && (r.values[n] = t * e.size, i(a));
		};
		if (d.addEventListener("change", () => d.value.trim() === "" ? l(f) : p(+d.value, !0)), e.parameter) {
			let [n, r] = e.range ?? he(e.value), i = t("input", u, {
				type: "range",
				min: n / e.size,
				max: r / e.size,
				step: "any",
				"aria-label": `${e.label}, slider`
			});
			f.slide = i, i.addEventListener("input", () => p(+i.value, !1)), i.addEventListener("change", () => p(+i.value, !0));
		}
		a.push(f);
	}
	let l = (e) => {
		let t = r.values[e.n] / e.field.size;
		document.activeElement !== e.box && (e.box.value = String(+t.toPrecision(6))), e.slide && document.activeElement !== e.slide && (e.slide.value = String(t)), e.box.classList.toggle("changed", r.values[e.n] !== e.field.value);
	};
	return { update: () => a.forEach(l) };
}
function me(e) {
	let t = e.indexOf(": ");
	return t < 0 ? ["Others", e] : [e.slice(0, t), e.slice(t + 2)];
}
function he(e) {
	let t = .5 * Math.abs(e) || 1;
	return [e - t, e + t];
}
function ge(e, n, r) {
	let i = t("tbody", t("table", e, { class: "answers" })), a = n.views.table.map((e) => {
		let r = t("tr", i), a = n.units[e.kind];
		return t("th", r, { scope: "row" }, s(e.name)), {
			r: e,
			unit: a,
			cell: t("td", r)
		};
	});
	return { update() {
		for (let { r: e, unit: t, cell: n } of a) {
			let i = e.rows.map((e) => r.here[e] / t.size), a = (e) => t.unit === "°" ? `${U(e, 5)}°` : `${U(e)} ${t.unit}`;
			n.textContent = r.solved ? i.length === 1 ? a(i[0]) : `${a(Math.hypot(...i))}${i.length === 2 ? ` at ${U(Math.atan2(i[1], i[0]) * 180 / Math.PI)}°` : ""}  (${i.map((e) => U(e)).join(", ")})` : "–";
		}
	} };
}
function _e(e, n, r, i) {
	let { terms: a, about: o } = i.equations, { force: c, moment: l } = n.units, u = a[0]?.f.length ?? 2, d = [
		"x",
		"y",
		"z"
	].slice(0, u).map((e, t) => ({
		head: `ΣF${e}`,
		unit: c,
		sign: (t) => s(t.name) + e,
		row: (e) => e.f[t]
	}));
	(u === 2 ? [""] : [
		"x",
		"y",
		"z"
	]).forEach((e, t) => d.push({
		head: `ΣM${e} about ${o}`,
		unit: l,
		sign: (t) => `M${e}(${s(t.name)})`,
		row: (e) => e.m[t]
	}));
	let f = d.map((n) => ({
		sum: n,
		el: t("p", e, { class: "equation" })
	}));
	return { update() {
		for (let { sum: e, el: t } of f) {
			let n = a.map((t) => r.here[e.row(t)] / e.unit.size), i = Math.max(...n.map(Math.abs), 0), o = n.map((e, t) => ({
				v: e,
				k: t
			})).filter((e) => Math.abs(e.v) > 1e-9 * i);
			if (!r.solved || !o.length) {
				t.textContent = `${e.head}: ${r.solved ? "nothing acts" : "no answer here"}`;
				continue;
			}
			let s = o.map((t) => e.sign(a[t.k])).join(" + "), c = o.reduce((e, t) => e + t.v, 0), l = o.map((e, t) => (e.v < 0 ? t ? " − " : "−" : t ? " + " : "") + U(Math.abs(e.v))).join("");
			t.textContent = `${e.head}: ${s} = ${l} = ${U(Math.abs(c) < 1e-9 * i ? 0 : c)} ${e.unit.unit}`;
		}
	} };
}
function ve(e, n) {
	t("p", e, {}, "Forces and motion are found by one linear system at each position (D'Alembert's principle); every number drawn here is computed anew from the numbers beside it, in double precision.");
	let r = t("dl", e);
	for (let [e, i] of Object.entries(n.assumptions)) t("dt", r, {}, e), t("dd", r, {}, i);
	n.source && t("p", e, {}, `Source: ${n.source}`), t("p", e, {}, `Made with dalembert ${n.version}.`);
}
// src/results.ts
var ye = (e) => e.closest("details")?.open ?? !0;
function be(e, n, r, i, a) {
	let { charts: o, bodies: s, polygons: c } = n.views, l = [], u = [];
	if (r.count > 1) for (let t of o) l.push(ne(e, n, r, t, i));
	let d = Y(e, "Free body", !0), f = t("select", d, { "aria-label": "link" }), p = s.map((e, i) => {
		t("option", f, { value: i }, `${e.title}${e.member && `, ${e.member} member`}`);
		let a = t("div", d, { class: "body" }), o = ee(a, r, e, e.about, 110, 100, n.units, `free body of ${e.title}`);
		return u.push({
			box: a,
			view: o,
			link: i
		}, {
			box: a,
			view: _e(a, n, r, e),
			link: i
		}), o;
	});
	if (c.links.length) {
		let t = Y(e, "Force polygon"), i = Y(e, "Force polygons of the chain");
		c.links.forEach((e, i) => {
			let a = ie(t, n, r, `Force polygon of link ${e.title}`, [e]);
			u.push({
				box: a.figure,
				view: a,
				link: i
			});
		});
		let a = c.chain.map((e) => c.links[e]);
		u.push({
			box: i,
			view: ie(i, n, r, `In the order of solution: ${a.map((e) => e.title).join(" → ")}`, a)
		});
	}
	let m = r.count > 2 ? o.flatMap((e) => e.curves).filter((e) => e.f) : [];
	if (m.length) {
		let t = Y(e, "Polar diagrams");
		for (let e of m) u.push({
			box: t,
			view: re(t, r, e, n.units.force)
		});
	}
	let h = Y(e, "Numbers of this position");
	return u.push({
		box: h,
		view: ge(h, n, r)
	}), f.addEventListener("change", a), {
		bodies: p,
		choose(e) {
			let t = s.findIndex((t) => t.link === e);
			t >= 0 && (f.value = String(t)), a();
		},
		update(e) {
			for (let t of l) t.update(e);
			for (let { box: t, view: n, link: r } of u) r !== void 0 && (t.hidden = r !== +f.value), (r === void 0 || r === +f.value) && ye(t) && n.update(e);
		}
	};
}
// src/toolbar.ts
function xe(e, n, r, i) {
	let a = t("header", e);
	t("h1", a, {}, n.title);
	let o = t("div", a, {
		class: "bar",
		role: "toolbar",
		"aria-label": "cycle and page"
	}), s = (e, n, r) => {
		let i = t("button", o, {
			type: "button",
			title: n,
			.../^\w/.test(e) ? {} : { "aria-label": n }
		}, e);
		return i.addEventListener("click", r), i;
	}, c = s("▶", "play along the cycle (space)", i.play), l = t("input", o, {
		type: "range",
		min: 0,
		max: r.end,
		step: n.only_at_positions ? 1 : "any",
		"aria-label": "place of the cycle"
	}), u = t("output", o, { class: "readout" }), d = s("↶", "undo (Ctrl+Z)", () => i.go(!0)), f = s("↷", "redo (Ctrl+Y)", () => i.go(!1));
	s("Reset", "all numbers as in the file", i.reset);
	let p = t("p", a, {
		class: "mark",
		role: "status"
	});
	l.addEventListener("input", () => i.show(+l.value));
	for (let e of [
		c,
		l,
		u
	]) e.hidden = r.count < 2;
	return {
		playing: (e) => c.textContent = e ? "❚❚" : "▶",
		update(e, t) {
			let { sentence: i } = n.statuses[r.mark];
			p.textContent !== i && (p.textContent = i), l.value = String(e), u.textContent = n.drives.map((t) => `${t.name} = ${U(r.position(t.name, e) / t.size, 5)}${t.unit === "°" ? "" : " "}${t.unit}`).join(", "), [d.disabled, f.disabled] = t.map((e) => !e);
		}
	};
}
// src/tools.ts
var Se = class {
	b;
	data;
	kernel;
	on = !1;
	arrows;
	constructor(t, n, r) {
		this.b = t, this.data = n, this.kernel = r;
		let i = e("g", t.svg, { class: "gradient" }), a = n.gradient ? n.handles.flatMap((e) => "ends" in e && e.ends.length ? [e] : []) : [];
		this.arrows = a.map((e) => ({
			p: e.p,
			ends: e.ends,
			arrow: new f(i, "acceleration", `lower the peak by ${e.name}`)
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
}, Ce = class {
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
}, we = class {
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
function X(e, t) {
	return Object.fromEntries(e.numbers.flatMap((e, n) => t.values[n] === e.value ? [] : [[e.path, t.values[n]]]));
}
function Z(e, t, n) {
	e.numbers.forEach((e, r) => t.values[r] = Number.isFinite(n[e.path]) ? n[e.path] : e.value);
}
function Te(e, t, n) {
	let r = new URLSearchParams({ t: String(+n.toFixed(4)) });
	for (let [n, i] of Object.entries(X(e, t))) r.set(n, String(i));
	return r.toString();
}
function Ee(e, t, n) {
	let r = new Map([...new URLSearchParams(n.replace(/^#/, ""))].map(([e, t]) => [e, t.trim() ? Number(t) : NaN])), i = r.get("t") ?? 0;
	return r.delete("t"), Z(e, t, Object.fromEntries(r)), Number.isFinite(i) ? Math.min(Math.max(i, 0), t.end) : 0;
}
function De(e, t) {
	return e.template.map((e, n) => n % 2 ? String(t.values[+e]) : e).join("");
}
function Oe(e, t) {
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
function ke(t, n) {
	let r = t.cloneNode(!0), { width: i, height: a } = t.viewBox.baseVal;
	r.querySelectorAll(".handles").forEach((e) => e.remove()), r.setAttribute("xmlns", "http://www.w3.org/2000/svg"), r.setAttribute("width", `${i}mm`), r.setAttribute("height", `${a}mm`), r.setAttribute("font-family", "'DejaVu Sans', Arial, sans-serif");
	let o = e("style", null);
	return o.textContent = n, r.prepend(o), new XMLSerializer().serializeToString(r);
}
function Q(e, t, n) {
	let r = document.createElement("a");
	r.href = URL.createObjectURL(new Blob([t], { type: n })), r.download = e, r.click(), setTimeout(() => URL.revokeObjectURL(r.href), 1e3);
}
var Ae = (e) => s(e).toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "").slice(0, 60) || "mechanism", je = 6;
async function $(e, n, r = {}) {
	if (n.format !== "dalembert-page/1") throw Error(`this page cannot show data of the form ${n.format}`);
	let i = await de.create(n), a = document.createElement("div"), o = [];
	a.className = "dalembert", a.tabIndex = -1;
	let c = `@media (prefers-color-scheme:dark){${n.style.dark}}@media print{${n.style.light}}`;
	t("style", a).textContent = fe + n.style.light + c, r.changes && Z(n, i, r.changes);
	let l = r.address ? Ee(n, i, location.hash) : 0, u = 0, d = !0, f = 0;
	i.cycle();
	let p = new we(i), m = n.views.charts.flatMap((e) => e.curves.map((t) => ({
		curve: t,
		unit: n.units[e.kind]
	}))), h = m.find((e) => n.gradient?.curves.includes(e.curve.row)), g = xe(a, n, i, {
		play: F,
		show: P,
		go: N,
		reset: M
	}), _ = t("main", a), v = t("section", _, {
		class: "stage",
		"aria-label": "mechanism"
	}), y = n.views.mechanism, b = ee(v, i, y, null, 170, I(i, y, 170), n.units, "the mechanism"), x = new Se(b, n, i), S = new Ce(v, b, n, i, n.handles.flatMap((e) => e.kind === "joint" || e.kind === "point" ? [e.p] : [])), C = ae(b, n, i, {
		changed: () => R(!0),
		finished: j,
		seek: P,
		time: () => l
	}), w = t("section", _, {
		class: "side",
		"aria-label": "results"
	}), T = be(w, n, i, {
		time: () => l,
		seek: P,
		pick: (e) => (h = m.find((t) => t.curve === e), R(!0)),
		picked: () => h?.curve
	}, () => R(!0)), E = O(), D = pe(Y(w, "Change numbers", n.numbers.some((e) => e.parameter)), n, i, (e) => e ? j() : R(!0));
	ve(Y(w, "Method and assumptions"), n), k(), b.svg.addEventListener("click", (e) => T.choose(e.target.closest("[data-link]")?.dataset.link));
	function O() {
		let e = t("div", v, { class: "switches" }), r = (n, r, i, a) => {
			let o = t("label", e, { title: r }), s = t("input", o, { type: "checkbox" });
			s.checked = i, o.append(n), s.addEventListener("change", () => (a(s.checked), R(!0)));
		};
		return r("names", "names of joints", b.names, (e) => b.names = e), n.gradient && r("what lowers the peak", "arrows: moving a joint this way lowers the peak of the chosen curve", !1, (e) => x.on = e), n.handles.some((e) => e.kind === "joint") && r("tolerances", "a thousand machines with points up to 0.5 % of the drawing's width off", !1, (e) => S.on = e), b.paper.axes.length > 2 && (t("span", e, {}, "drag to look from elsewhere"), Me([b, ...T.bodies], () => R(!0))), t("span", e, { class: "spread" });
	}
	function k() {
		let e = Y(w, "Save and share"), a = Ae(n.title), o = (n, r) => t("button", e, { type: "button" }, n).addEventListener("click", r);
		o("Model file", () => Q(`${a}.yaml`, De(n, i), "text/yaml")), o("Curves as CSV", () => Q(`${a}.csv`, Oe(n, i), "text/csv")), o("Drawing as SVG", () => Q(`${a}.svg`, ke(b.svg, n.style.light), "image/svg+xml")), o("Print", () => window.print()), r.address && o("Copy link", () => {
			location.hash = Te(n, i, l), navigator.clipboard?.writeText(location.href);
		});
	}
	function A() {
		R(!0), D.update(), r.edited?.(X(n, i)), r.address && window.history.replaceState(null, "", "#" + Te(n, i, l));
	}
	function j() {
		p.note(), b.fit(), A();
	}
	function M() {
		Z(n, i, {}), j();
	}
	function N(e) {
		p.go(e) && A();
	}
	function P(e) {
		l = Math.min(Math.max(e, 0), i.end), n.only_at_positions && (l = Math.round(l)), R(!1);
	}
	function F() {
		if (g.playing(!f), f) return L();
		let e = performance.now(), t = l, n = (r) => {
			t += (r - e) / 1e3 / je * i.end, e = r, t >= i.end && (t = 0), P(t), f = requestAnimationFrame(n);
		};
		f = requestAnimationFrame(n);
	}
	function L() {
		cancelAnimationFrame(f), f = 0;
	}
	function R(e) {
		d ||= e, u ||= requestAnimationFrame(() => {
			u = 0;
			let e = performance.now();
			z(), o.push(performance.now() - e), o.length > 2e3 && o.shift();
		});
	}
	function z() {
		let e = d;
		d = !1, e && i.cycle(), i.at(l), a.classList.toggle("unsolved", !i.solved), b.update(e), C(), x.update(h?.curve);
		let t = S.update(h?.curve.row);
		E.textContent = t && h ? `${s(h.curve.name)}: ${U(t.mean / h.unit.size)} ± ${U(t.sigma / h.unit.size, 2)} ${h.unit.unit} (1 σ)` : "", T.update(e), g.update(l, p.can);
	}
	return a.querySelectorAll("details").forEach((e) => e.addEventListener("toggle", () => R(!0))), a.addEventListener("keydown", (e) => {
		let t = /INPUT|SELECT|TEXTAREA/.test(e.target.tagName);
		(e.ctrlKey || e.metaKey) && !t && /^[zy]$/i.test(e.key) ? (e.preventDefault(), N(e.key.toLowerCase() === "z" && !e.shiftKey)) : e.key === " " && !t && e.target.tagName !== "BUTTON" && i.count > 1 && (e.preventDefault(), F());
	}), i.at(l), e.replaceChildren(a), b.fit(), z(), D.update(), {
		kernel: i,
		data: n,
		times: o,
		show: P,
		set(e) {
			Z(n, i, e), p.note(), b.fit(), R(!0), D.update();
		},
		text: () => De(n, i),
		remove: () => (L(), a.remove())
	};
}
function Me(e, t) {
	for (let n of e) n.svg.style.cursor = "move", n.svg.addEventListener("pointerdown", (e) => n.svg.setPointerCapture(e.pointerId)), n.svg.addEventListener("pointermove", (r) => {
		if (n.svg.hasPointerCapture(r.pointerId)) {
			for (let t of e) t.paper.turn(-.01 * r.movementX, .01 * r.movementY), t.fit();
			t();
		}
	});
}
// src/main.ts
var Ne = { async render({ model: e, el: t }) {
	let n = "", r = (t) => {
		n = JSON.stringify(t), e.set("changes", t), e.save_changes();
	}, i = () => $(t, e.get("data"), {
		edited: r,
		changes: e.get("changes")
	}), a = await i(), o = async () => {
		a.remove(), a = await i();
	}, s = () => JSON.stringify(e.get("changes")) !== n && a.set(e.get("changes"));
	return e.on("change:data", o), e.on("change:changes", s), () => {
		e.off("change:data", o), e.off("change:changes", s), a.remove();
	};
} };
export { Ne as default, $ as mount };
