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
var n = (e) => Math.abs(e) < .005 ? "0" : e.toFixed(2);
function r(e, t = !1) {
	return e.length ? "M" + e.map(([e, t]) => n(e) + " " + n(t)).join("L") + (t ? "Z" : "") : "";
}
function i(e, t, r) {
	e.setAttribute("transform", `translate(${n(t)} ${n(r)})`);
}
function a(t, n, r) {
	t.replaceChildren();
	let i = !1;
	for (let a of n.split(/(_\{[^}]*\})/)) {
		if (!a) continue;
		let n = a.startsWith("_{"), o = e("tspan", t, n ? { "font-size": .7 * r } : {});
		o.textContent = n ? a.slice(2, -1) : a, n !== i && o.setAttribute("dy", String((n ? .25 : -.25) * r)), i = n;
	}
}
var o = (e) => e.replace(/_\{([^}]*)\}/g, "$1"), s = null, c = /* @__PURE__ */ new Map();
function l(e, t, n = !1) {
	let r = `${n}${e}`, i = c.get(r);
	if (i === void 0) {
		s ??= document.createElement("canvas").getContext("2d"), s.font = `${n ? "bold " : ""}100px "DejaVu Sans", "Helvetica Neue", Arial, sans-serif`, i = 0;
		for (let t of e.split(/(_\{[^}]*\})/)) {
			let e = t.startsWith("_{");
			i += s.measureText(e ? t.slice(2, -1) : t).width / 100 * (e ? .7 : 1);
		}
		c.set(r, i);
	}
	return i * t;
}
function u(t, n, r, i, o = "middle") {
	let s = e("text", t, {
		class: `l-${n}-t`,
		"font-size": i,
		"text-anchor": o
	});
	return a(s, r, i), s;
}
var d = class {
	g;
	shaft;
	head;
	constructor(t, n, r = "") {
		this.g = e("g", t), r && (e("title", this.g).textContent = o(r)), this.shaft = e("path", this.g, {
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
function f(e) {
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
var p = [
	[1, -1],
	[-1, -1],
	[1, 1],
	[-1, 1],
	[0, -1],
	[1, 0],
	[-1, 0],
	[0, 1]
], m = [
	1,
	1.9,
	3,
	4.5
];
function h(e, t, n, r) {
	return {
		el: u(e, t, n, r),
		text: n,
		size: r,
		bold: t === "title",
		choice: -1
	};
}
var g = class {
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
		let t = e.label, n = l(t.text, t.size, t.bold) + .5, r = 1.1 * t.size + (t.text.includes("_") ? .3 * t.size : 0), a = e.leave ?? 1.2, o = e.away && Math.hypot(...e.away) || 1, s = Infinity, c = 0, u = [
			0,
			0,
			0,
			0
		], d = 0;
		for (let [i, l] of e.anchors) for (let f of m) for (let [m, h] of p) {
			let p = a * f, g = i + m * (p + n / 2), _ = l + h * (p + r / 2), v = [
				g - n / 2,
				_ - r / 2,
				g + n / 2,
				_ + r / 2
			], y = d % 32 * .12 + .2 * Math.floor(d / 32) - (d === t.choice ? .4 : 0);
			e.away && (y += 1.2 * (1 - (m * e.away[0] + h * e.away[1]) / (Math.hypot(m, h) * o))), y < s && (y += this.cost(v)) < s && (s = y, c = d, u = v), d++;
		}
		t.choice = c, this.texts.push(u), i(t.el, (u[0] + u[2]) / 2, u[1] + .91 * t.size);
	}
	cost(e) {
		let t = 0;
		for (let n of this.texts) _(e, n) > 0 && (t += 60 + 5 * _(e, n));
		for (let n of this.discs) _(e, n) > 0 && (t += 8 + _(e, n));
		for (let [n, r] of this.lines) v(e, n, r) && (t += 6);
		let [n, r, i, a] = this.bounds;
		return (e[0] < n || e[1] < r || e[2] > i || e[3] > a) && (t += 20), t;
	}
};
function _(e, t) {
	let n = Math.min(e[2], t[2]) - Math.max(e[0], t[0]), r = Math.min(e[3], t[3]) - Math.max(e[1], t[1]);
	return n > 0 && r > 0 ? n * r : 0;
}
function v(e, t, n) {
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
var y = class {
	kernel;
	perMm;
	middle = [0, 0];
	azimuth = -Math.PI / 3;
	elevation = .45;
	constructor(e, t) {
		this.kernel = e, this.perMm = t;
	}
	seen(e, t) {
		let n = t(e[0]), r = t(e[1]);
		if (e.length < 3) return [n, r];
		let i = Math.cos(this.azimuth), a = Math.sin(this.azimuth), o = Math.cos(this.elevation), s = Math.sin(this.elevation);
		return [i * r - a * n, o * t(e[2]) - s * (i * n + a * r)];
	}
	depth(e) {
		let [t, n, r] = e.map((e) => this.kernel.here[e]);
		return Math.cos(this.elevation) * (Math.cos(this.azimuth) * t + Math.sin(this.azimuth) * n) + Math.sin(this.elevation) * r;
	}
	here(e) {
		return this.seen(e, (e) => this.kernel.here[e]);
	}
	point(e) {
		return this.of(...this.here(e));
	}
	of(e, t) {
		return [(e - this.middle[0]) / this.perMm, (this.middle[1] - t) / this.perMm];
	}
	metres(e) {
		return [this.middle[0] + e[0] * this.perMm, this.middle[1] - e[1] * this.perMm];
	}
};
function b(t, i, a) {
	let o = a.kernel, s = o.here;
	if (i.t === "symbol") {
		let r = e("g", t, i.per_mm ? { class: "span" } : {});
		return r.innerHTML = i.svg, {
			update() {
				let [e, t] = a.point(i.p), o = i.per_mm ? ` scale(${(i.per_mm / a.perMm).toFixed(4)})` : "", c = i.e ? ` rotate(${n(-Math.atan2(s[i.e[1]], s[i.e[0]]) * 180 / Math.PI)})` : "";
				r.setAttribute("transform", `translate(${n(e)} ${n(t)})${c}${o}`);
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
			r.setAttribute("cx", n(e)), r.setAttribute("cy", n(t)), r.setAttribute("r", n(Math.abs(s[i.r]) / a.perMm));
		} };
	}
	if (i.t === "pair") return x(t, i, a);
	let c = e("path", t, {
		class: `l-${i.role}`,
		style: "fill:none"
	});
	if (i.t === "trace") return { update: () => c.setAttribute("d", S(o, a, i.p[0])) };
	let l = () => i.p.map((e) => a.point(e)), u = (e) => {
		let t = i.t === "hull" ? f(l()) : l();
		for (let n = 0; n + 1 < t.length; n++) e.line(t[n], t[n + 1]);
		t.length > 2 && e.line(t[t.length - 1], t[0]);
	};
	return i.t === "path" ? {
		update: () => c.setAttribute("d", r(l())),
		mark: u
	} : (c.dataset.link = i.link, {
		update() {
			let e = f(l()), t = e.length > 2;
			c.setAttribute("class", t ? "l-link-area" : "l-link"), c.setAttribute("style", t ? "" : "fill:none"), c.setAttribute("d", r(t ? e : l(), t));
		},
		mark: u
	});
}
function x(t, r, i) {
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
function S(e, t, r) {
	let i = "", a = !1;
	for (let o = 0; o <= e.count; o++) {
		let s = o < e.count ? o : 0;
		if (!e.good(s) || o === e.count && !e.cyclic) {
			a = !1;
			continue;
		}
		let [c, l] = t.of(...t.seen(r, (t) => e.value(t, s)));
		i += `${a ? "L" : "M"}${n(c)} ${n(l)}`, a = !0;
	}
	return i;
}
function C(e, t, n, r, i) {
	return t.t === "couple" ? D(e, t, n) : T(e, t, n, r, i);
}
var w = 13;
function T(e, t, n, r, i) {
	let a = new d(e, t.role, t.name), o = t.t === "moment" ? new d(e, t.role) : null, s = h(e, t.role, t.name, 3.4), c = [0, 0], l = [0, 0], u = [0, 0], f = !1;
	return {
		label: s,
		update() {
			let e = n.point(t.p), [d, p] = n.here(t.f), m = o ? Math.hypot(...t.f.map((e) => n.kernel.here[e])) / w || 1 : r(), h = [d / m, -p / m], g = !1;
			if (i && i.length > 1 && !o) {
				let t = i.map((e) => n.point(e)), r = [0, 1].map((e) => t.reduce((t, n) => t + n[e], 0) / t.length);
				g = h[0] * (r[0] - e[0]) + h[1] * (r[1] - e[1]) > 1e-9;
			}
			[c, l] = g ? [[e[0] - h[0], e[1] - h[1]], e] : [e, [e[0] + h[0], e[1] + h[1]]], u = g ? c : l, f = a.set(c, l), o?.set(c, [c[0] + .78 * (l[0] - c[0]), c[1] + .78 * (l[1] - c[1])]), s.el.setAttribute("visibility", f ? "visible" : "hidden");
		},
		mark: (e) => f && e.line(c, l),
		anchor() {
			if (!f) return null;
			let e = u === c ? l : c, t = [u[0] - e[0], u[1] - e[1]];
			return [
				u,
				[u[0] - .35 * t[0], u[1] - .35 * t[1]],
				t
			];
		}
	};
}
var E = 4.6;
function D(t, r, i) {
	let a = i.kernel.here, s = e("g", t), c = h(t, r.role, r.name, 3.4);
	e("title", s).textContent = o(r.name), e("path", s, {
		class: `l-${r.role}`,
		style: "fill:none",
		d: "M4.17 1.94A4.6 4.6 0 1 0 -4.17 1.94"
	}), e("path", s, {
		class: `l-${r.role}-h`,
		d: "M-4.17 2.9L-5.6 -0.1L-3 0.3Z"
	});
	let l = !1;
	return {
		label: c,
		update() {
			let [e, t] = i.point(r.p), o = a[r.m];
			l = Number.isFinite(o) && Math.abs(o) > 1e-9, s.setAttribute("display", l ? "inline" : "none"), c.el.setAttribute("visibility", l ? "visible" : "hidden"), s.setAttribute("transform", `translate(${n(e)} ${n(t)}) scale(${o < 0 ? -1 : 1} 1)`);
		},
		mark(e) {
			l && e.disc(i.point(r.p), E * .7);
		},
		anchor() {
			let [e, t] = i.point(r.p);
			return l ? [[e, t - E], [0, -1]] : null;
		}
	};
}
// src/board.ts
var O = [
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
function k(e) {
	if (!(e > 0) || !Number.isFinite(e)) return 1;
	let t = 10 ** Math.floor(Math.log10(e) + 1e-12);
	return t * (O.find((n) => n * t >= e * (1 - 1e-12)) ?? 10);
}
function A(e, t, n) {
	let r = t.items.flatMap((e) => e.t === "hull" || e.t === "path" ? e.p : e.t === "symbol" || e.t === "pair" ? [e.p] : []), i = new y(e, 1), a = [Infinity, Infinity], o = [-Infinity, -Infinity];
	for (let t of r) for (let n = 0; n < e.count; n++) e.good(n) && i.seen(t, (t) => e.value(t, n)).forEach((e, t) => (a[t] = Math.min(a[t], e), o[t] = Math.max(o[t], e)));
	let s = [o[0] - a[0], o[1] - a[1]], c = s[1] / s[0];
	return Number.isFinite(c) ? Math.min(Math.max(n * c * 1.05, 96), 150) : 120;
}
function j(t, n, r, i) {
	return e("svg", t, {
		viewBox: `${-n / 2} ${-r / 2} ${n} ${r}`,
		role: "group",
		"aria-label": i
	});
}
function M(t, n, r, i, a, o, s, c) {
	let l = {
		length: s.length.size,
		force: s.force.size
	}, u = j(t, a, o, c), d = new y(n, r.per_mm), f = [], p = [], m = [], _ = [], v = r.force;
	r.middle && (d.middle = r.middle);
	let x = e("g", u), S = e("g", u), w = e("g", u);
	for (let e of r.items) (e.t === "trace" ? f : p).push(b(x, e, d));
	for (let e of r.arrows) m.push(C(S, e, d, () => v, i ?? void 0));
	for (let e of r.labels) _.push({
		l: h(w, e.role, e.text, e.kind === "joint" ? 3.8 : 3.3),
		p: e.p,
		q: e.q
	});
	let T = e("text", w, {
		class: "l-note-t",
		"font-size": 2.8,
		x: -a / 2 + 2,
		y: o / 2 - 2
	}), E = [
		-a / 2,
		-o / 2,
		a / 2,
		o / 2 - 4
	], D = (e) => [Math.min(...e), Math.max(...e)];
	function O() {
		if (!i) return;
		let e = i.map((e) => d.here(e)), [t, n] = D(e.map((e) => e[0])), [r, a] = D(e.map((e) => e[1]));
		Number.isFinite(t + n + r + a) && (d.middle = [(t + n) / 2, (r + a) / 2]);
	}
	function A() {
		let e = [], t = [], s = i ?? r.items.flatMap((e) => e.t === "hull" || e.t === "path" ? e.p : e.t === "symbol" || e.t === "pair" ? [e.p] : []), c = Math.max(1, Math.floor(n.count / 72));
		for (let r of s) for (let a = 0; a < n.count; a += i ? n.count : c) if (i || n.good(a)) {
			let [o, s] = i ? d.here(r) : d.seen(r, (e) => n.value(e, a));
			e.push(o), t.push(s);
		}
		if (e.length) {
			let [n, s] = D(e), [c, u] = D(t), f = i ? [46, 40] : [a * .76, o * .74], p = Math.max((s - n) / f[0], (u - c) / f[1]) || r.per_mm;
			i || (d.middle = [(n + s) / 2, (c + u) / 2]), d.perMm = k(p / l.length) * l.length;
		}
		let u = 0;
		for (let e of r.arrows) if (e.t === "force") for (let t = 0; t < n.count; t++) n.good(t) && (u = Math.max(u, Math.hypot(...e.f.map((e) => n.value(e, t)))));
		u > 0 && (v = k(u / (i ? 26 : 22) / l.force) * l.force);
	}
	let M = {
		svg: u,
		paper: d,
		fit: A,
		force: () => v,
		names: r.labels.filter((e) => e.kind === "joint").length <= 8,
		update(e) {
			if (e && f.forEach((e) => e.update()), S.setAttribute("visibility", n.solved ? "visible" : "hidden"), !n.finite) return;
			O(), p.forEach((e) => e.update()), m.forEach((e) => e.update());
			let t = new g(E);
			p.forEach((e) => e.mark?.(t)), m.forEach((e) => e.mark?.(t));
			for (let { l: e, p: n, q: r } of _) {
				let i = M.names || !!r;
				if (e.el.setAttribute("visibility", i ? "visible" : "hidden"), !i) continue;
				let a = d.point(n), o = r ? d.point(r) : a, s = (r ? [
					.5,
					.35,
					.65
				] : [0]).map((e) => [a[0] + e * (o[0] - a[0]), a[1] + e * (o[1] - a[1])]);
				t.put({
					label: e,
					anchors: s,
					away: r ? void 0 : a,
					leave: r ? .8 : 1.3
				});
			}
			for (let e of m) {
				let r = n.solved ? e.anchor() : null;
				r ? t.put({
					label: e.label,
					anchors: r.slice(0, -1),
					away: r[r.length - 1],
					leave: .9
				}) : e.label.el.setAttribute("visibility", "hidden");
			}
			T.textContent = `1 mm = ${+(d.perMm / l.length).toPrecision(4)} ${s.length.unit}, ${+(v / l.force).toPrecision(4)} ${s.force.unit}`;
		}
	};
	return M;
}
// src/charts.ts
var ee = 120, te = 52;
function N(e, t, n) {
	let r = (t - e) / n, i = 10 ** Math.floor(Math.log10(r || 1)), a = i * ([
		1,
		2,
		5,
		10
	].find((e) => e * i >= r) ?? 10), o = [];
	for (let n = Math.ceil(e / a - 1e-9); n * a <= t * (1 + 1e-12) + 1e-9 * a; n++) o.push(n * a);
	return o;
}
var P = (e, t = 4) => Number.isFinite(e) ? String(+e.toPrecision(t)).replace("-", "−") : "–";
function ne(r, i, o, s, c, u, d, f) {
	let p = t("figure", r, { class: "chart" }), m = i.units[s.kind] ?? {
		unit: "",
		size: 1
	};
	t("figcaption", p, {}, `${s.title}, ${m.unit}`);
	let h = Math.min(Math.max(...s.curves.map((e) => l(e.name, 3))) + 4, 36), g = j(p, ee, te, s.title), _ = 104 - h, v = e("path", g, {
		class: "l-grid",
		style: "fill:none"
	}), y = e("path", g, {
		class: "l-axis",
		style: "fill:none"
	}), b = e("g", g), x = s.curves.map((t) => e("path", g, {
		class: `l-${t.role}`,
		style: "fill:none"
	})), S = e("path", g, { class: "cursor" }), C = s.curves.map((t) => e("circle", g, {
		class: `l-${t.role}-h`,
		r: .9
	})), w = i.drives[0], T = Math.max(o.count - 1, 1), E = s.curves.map((t, n) => {
		let r = e("text", g, {
			class: `l-${t.role}-t key`,
			"font-size": 3,
			x: -44 + _ + 2,
			y: -18 + 4 * n,
			tabindex: 0,
			role: "button"
		});
		return a(r, t.name, 3), e("title", r).textContent = "show what lowers its peak", r.addEventListener("click", () => d(t)), r.addEventListener("keydown", (e) => e.key === "Enter" && d(t)), r;
	}), D = i.noise[s.kind] ?? 0, O = (e, t) => {
		let n = o.value(e.row, t);
		return Math.abs(n) < D ? 0 : n;
	}, k = (e) => e, A = (e) => -44 + e / T * _;
	function M() {
		let t = Infinity, r = -Infinity;
		for (let e of s.curves) for (let n = 0; n < o.count; n++) if (o.good(n)) {
			let i = O(e, n) / m.size;
			t = Math.min(t, i), r = Math.max(r, i);
		}
		t <= r || ([t, r] = [0, 1]), t > 0 && t < .4 * r && (t = 0), r < 0 && r > .4 * t && (r = 0), r - t < 1e-9 * Math.max(Math.abs(r), 1e-9) && ([t, r] = [Math.min(t, 0), Math.max(r, 0) || 1]);
		let i = N(t, r, 4), a = .04 * (r - t);
		[t, r] = [t - a, r + a], k = (e) => 18 - (e / m.size - t) / (r - t) * 39, b.replaceChildren();
		let c = "";
		for (let t of i) c += `M-44 ${n(k(t * m.size))}h${_}`, e("text", b, {
			class: "l-note-t",
			"font-size": 2.6,
			"text-anchor": "end",
			x: -45.2,
			y: k(t * m.size) + .9
		}).textContent = P(t, 5);
		if (w) {
			let t = [0, T].map((e) => o.position(w.name, e) / w.size);
			for (let r of N(Math.min(...t), Math.max(...t), 5)) {
				let i = -44 + (r - t[0]) / (t[1] - t[0] || 1) * _;
				c += `M${n(i)} -21v39`, e("text", b, {
					class: "l-note-t",
					"font-size": 2.6,
					"text-anchor": "middle",
					x: i,
					y: 21.4
				}).textContent = P(r, 5) + (w.unit === "°" ? "°" : "");
			}
			e("text", b, {
				class: "l-note-t",
				"font-size": 2.6,
				"text-anchor": "end",
				x: -44 + _,
				y: 24.6
			}).textContent = `${w.name}, ${w.unit}`;
		}
		v.setAttribute("d", c), y.setAttribute("d", "M-44 -21v39" + (t < 0 && r > 0 ? `M-44 ${n(k(0))}h${_}` : "")), x.forEach((e, t) => e.setAttribute("d", ne((e) => A(e), (e) => k(O(s.curves[t], e)))));
	}
	function ne(e, t) {
		let r = "", i = !1;
		for (let a = 0; a < o.count; a++) o.good(a) && (r += `${i ? "L" : "M"}${n(e(a))} ${n(t(a))}`), i = o.good(a);
		return r;
	}
	let F = (e) => {
		u((new DOMPoint(e.clientX, e.clientY).matrixTransform(g.getScreenCTM().inverse()).x - -44) / _ * T);
	};
	return g.addEventListener("pointerdown", (e) => {
		e.target.closest(".key") || (g.setPointerCapture(e.pointerId), F(e));
	}), g.addEventListener("pointermove", (e) => e.buttons && g.hasPointerCapture(e.pointerId) && F(e)), { update(e) {
		e && M();
		let t = Math.min(c(), T);
		S.setAttribute("d", `M${n(A(t))} -21v39`), s.curves.forEach((e, r) => {
			C[r].setAttribute("visibility", o.solved ? "visible" : "hidden"), o.solved && (C[r].setAttribute("cx", n(A(t))), C[r].setAttribute("cy", n(k(o.here[e.row])))), E[r].classList.toggle("picked", f() === e);
		});
	} };
}
function F(r, i, a, o) {
	let s = t("figure", r, { class: "polar" }), c = t("figcaption", s, {}, `Joint ${a.name}`), l = j(s, 66, 66, `polar diagram of joint ${a.name}`), u = e("path", l, {
		class: "l-grid",
		style: "fill:none"
	}), f = e("path", l, {
		class: `l-${a.role}`,
		style: "fill:none"
	}), p = new d(l, "joint-force", a.name), m = 1;
	return { update(e) {
		let [t, r] = a.f;
		if (e) {
			let e = 0;
			for (let n = 0; n < i.count; n++) i.good(n) && (e = Math.max(e, Math.hypot(i.value(t, n), i.value(r, n))));
			m = k(e / 28 / o.size) * o.size || o.size;
			let s = "", l = !1;
			for (let e = 0; e < i.count; e++) i.good(e) && (s += `${l ? "L" : "M"}${n(i.value(t, e) / m)} ${n(-i.value(r, e) / m)}`), l = i.good(e);
			f.setAttribute("d", s + (i.cyclic && s && !s.slice(1).includes("M") ? "Z" : "")), u.setAttribute("d", "M-30 0H30M0 -30V30M15 0A15 15 0 1 0 -15 0A15 15 0 1 0 15 0M30 0A30 30 0 1 0 -30 0A30 30 0 1 0 30 0"), c.textContent = `Joint ${a.name}: 1 mm = ${P(m / o.size)} ${o.unit}`;
		}
		let s = i.here;
		p.set([0, 0], i.solved ? [s[t] / m, -s[r] / m] : [0, 0]);
	} };
}
function re(n, i, a, o) {
	let s = t("figure", n, { class: "polygon" }), c = i.units.force;
	t("figcaption", s, {}, `Force polygon of link ${o.title}`);
	let l = j(s, 110, 80, `force polygon of link ${o.title}`), u = e("g", l), f = o.sides.map((e) => new d(l, e.role, e.name)), p = o.sides.map((e) => h(u, e.role, e.name, 3)), m = e("path", l, {
		class: "l-gap",
		style: "fill:none"
	}), _ = e("text", l, {
		class: "l-note-t",
		"font-size": 2.8,
		x: -53,
		y: 38
	});
	return {
		figure: s,
		update() {
			if (l.setAttribute("visibility", a.solved ? "visible" : "hidden"), !a.solved) return;
			let e = a.here, t = [[0, 0]];
			for (let n of o.sides) {
				let [r, i] = t[t.length - 1], a = n.t === "force" ? n.f : [0, 0];
				t.push([r + e[a[0]], i - e[a[1]]]);
			}
			let n = t.map((e) => e[0]), i = t.map((e) => e[1]), [s, u, d, h] = [
				Math.min(...n),
				Math.max(...n),
				Math.min(...i),
				Math.max(...i)
			], v = k(Math.max((u - s) / 66, (h - d) / 48) / c.size) * c.size, y = t.map(([e, t]) => [(e - (s + u) / 2) / v, (t - (d + h) / 2) / v]), b = new g([
				-55,
				-40,
				55,
				36
			]);
			for (let e = 0; e + 1 < y.length; e++) b.line(y[e], y[e + 1]);
			f.forEach((e, t) => {
				let n = e.set(y[t], y[t + 1]);
				if (p[t].el.setAttribute("visibility", n ? "visible" : "hidden"), !n) return;
				let r = [(y[t][0] + y[t + 1][0]) / 2, (y[t][1] + y[t + 1][1]) / 2];
				b.put({
					label: p[t],
					anchors: [r],
					away: r,
					leave: .9
				});
			}), m.setAttribute("d", r([y[0], y[y.length - 1]])), _.textContent = `1 mm = ${P(v / c.size)} ${c.unit}`;
		}
	};
}
// src/handles.ts
function ie(t, n, r, i, a) {
	let o = e("g", t.svg, { class: "handles" }), s = n.handles.map((e) => oe(o, t, e, r, i, a));
	return se(t, n, r, i), () => r.finite && s.forEach((e) => e());
}
function I(e, t, n, r, i) {
	let [a, o, s, c] = n;
	e.values[t.n[0]] = s * (r - a) + c * (i - o), e.values[t.n[1]] = s * (i - o) - c * (r - a);
}
var ae = (e, t) => [...t.at, ...t.e].map((t) => e.here[t]);
function L(e, t, n, r, i) {
	let a = e.values, o = new Float64Array(e.here.length), s = a.slice(), c = () => {
		e.other(s, o);
		let n = [r - o[t[0]], i - o[t[1]]];
		return Number.isFinite(n[0] + n[1]) ? n : null;
	};
	for (let e = 0; e < 4; e++) {
		s.set(a);
		let e = c();
		if (!e) return;
		let t = n.map((t) => {
			let n = 1e-6 * (Math.abs(a[t]) || 1);
			s[t] = a[t] + n;
			let r = c();
			return s[t] = a[t], r ? [(e[0] - r[0]) / n, (e[1] - r[1]) / n] : [0, 0];
		}), r = n.map((e) => Math.abs(a[e]) || 1), i = 0, o = 0, l = 0;
		t.forEach(([e, t], n) => (i += (e * r[n]) ** 2, o += e * t * r[n] ** 2, l += (t * r[n]) ** 2));
		let u = 1e-9 * (i + l) + 1e-300, d = (i + u) * (l + u) - o * o, f = [((l + u) * e[0] - o * e[1]) / d, ((i + u) * e[1] - o * e[0]) / d];
		for (let i = 1; i > .05; i /= 2) {
			n.forEach((e, n) => s[e] = a[e] + i * r[n] ** 2 * (t[n][0] * f[0] + t[n][1] * f[1]));
			let o = c();
			if (o && Math.hypot(...o) < Math.hypot(...e)) {
				n.forEach((e) => a[e] = s[e]);
				break;
			}
		}
	}
}
function R(e) {
	return "by" in e && e.by ? e.by : e.kind === "load" ? [...e.components ?? [], ...[e.size, e.direction].filter((e) => e !== void 0)] : e.kind === "direction" ? [e.direction] : e.ends.flatMap((e) => e.n);
}
function oe(t, n, r, i, a, o) {
	let s = `${{
		joint: "joint",
		point: "point",
		center: "",
		load: "force",
		direction: "direction of"
	}[r.kind]} ${r.name}`.trim(), c = e("circle", t, {
		class: `handle ${r.kind}`,
		r: r.kind === "joint" ? 2.6 : 2,
		tabindex: 0,
		role: "slider",
		"aria-label": `move ${s}`,
		"aria-valuetext": s,
		"aria-valuenow": 0,
		"data-kind": r.kind,
		"data-name": r.name
	});
	e("title", c).textContent = `drag ${s}`;
	let l = n.paper, u = i.here, d = [], f = !1, p = () => {
		let e = l.point(r.p);
		return r.kind === "load" ? [e[0] + u[r.f[0]] / o(), e[1] - u[r.f[1]] / o()] : r.kind === "direction" ? [e[0] + 16 * u[r.along[0]], e[1] - 16 * u[r.along[1]]] : e;
	}, m = () => {
		d = "ends" in r ? r.ends.map((e) => ae(i, e)) : [r.e.map((e) => u[e])], f = !0;
	}, h = (e) => {
		let [t, n] = l.metres(e);
		if ("by" in r && r.by) L(i, r.p, r.by, t, n);
		else if ("ends" in r) r.ends.forEach((e, r) => I(i, e, d[r], t, n));
		else {
			let [t, n] = d[0], a = l.point(r.p), s = e[0] - a[0], c = a[1] - e[1], u = [t * s + n * c, t * c - n * s];
			r.kind === "direction" ? i.values[r.direction] = z(Math.atan2(u[1], u[0]), i.values[r.direction]) : r.components ? r.components.forEach((e, t) => i.values[e] = u[t] * o()) : g(r, u);
		}
		a.changed();
	}, g = (e, t) => {
		let n = i.values, r = Math.hypot(...t) * o(), a = Math.sign(n[e.size]) || 1;
		if (e.direction !== void 0) n[e.direction] = z(Math.atan2(a * t[1], a * t[0]), n[e.direction]), n[e.size] = a * r;
		else {
			let r = [u[e.f[0]], u[e.f[1]]], [i, s] = d[0], c = [i * r[0] + s * r[1], i * r[1] - s * r[0]], l = Math.hypot(...c) || 1;
			n[e.size] = a * (t[0] * c[0] + t[1] * c[1]) * o() / l;
		}
	}, _ = () => {
		f && a.finished(R(r)), f = !1;
	};
	return c.addEventListener("pointerdown", (e) => {
		e.stopPropagation(), c.setPointerCapture(e.pointerId), m();
	}), c.addEventListener("pointermove", (e) => f && h(B(n, e))), c.addEventListener("pointerup", _), c.addEventListener("pointercancel", _), c.addEventListener("keydown", (e) => {
		let t = {
			ArrowLeft: [-1, 0],
			ArrowRight: [1, 0],
			ArrowUp: [0, -1],
			ArrowDown: [0, 1]
		};
		if (!t[e.key]) return;
		e.preventDefault(), e.stopPropagation(), m();
		let n = p(), r = e.shiftKey ? 5 : 1;
		h([n[0] + r * t[e.key][0], n[1] + r * t[e.key][1]]), _();
	}), () => {
		if (r.kind === "direction" && f) return;
		let [e, t] = p();
		c.setAttribute("visibility", Number.isFinite(e + t) ? "visible" : "hidden"), c.setAttribute("cx", e.toFixed(2)), c.setAttribute("cy", t.toFixed(2));
	};
}
var z = (e, t) => e - 2 * Math.PI * Math.round((e - t) / (2 * Math.PI));
function B(e, t) {
	let n = new DOMPoint(t.clientX, t.clientY).matrixTransform(e.svg.getScreenCTM().inverse());
	return [n.x, n.y];
}
function se(e, t, n, r) {
	let i = t.drives[0];
	if (!i || n.count < 2) return;
	let a = 0, o = 0, s = !1, c = (t) => {
		let n = B(e, t), r = e.paper.point(i.p);
		return i.turns ? Math.atan2(r[1] - n[1], n[0] - r[0]) : 0;
	};
	e.svg.addEventListener("pointerdown", (t) => {
		let n = t.target.closest("[data-link]");
		n && n.dataset.link === i.link && i.turns && (e.svg.setPointerCapture(t.pointerId), [a, o, s] = [
			c(t),
			r.time(),
			!0
		]);
	}), e.svg.addEventListener("pointermove", (e) => {
		if (!s) return;
		let t = (n.position(i.name, n.count - 1) - n.position(i.name, 0)) / (n.count - 1), l = c(e), u = o + z(l - a, 0) / t;
		n.cyclic && (u = (u % n.count + n.count) % n.count), [a, o] = [l, u], r.seek(u);
	}), e.svg.addEventListener("pointerup", () => s = !1);
}
// src/kernel.ts
var V = /* @__PURE__ */ new Set([
	0,
	9,
	12,
	13
]);
function H(e) {
	return Uint8Array.from(atob(e), (e) => e.charCodeAt(0));
}
function U(e) {
	if (typeof e == "string") return new Float64Array(H(e).buffer);
	let t = (e.to - e.from) / Math.max(e.count - 1, 1);
	return Float64Array.from({ length: e.count }, (n, r) => r === e.count - 1 ? e.to : e.from + r * t);
}
async function ce(e) {
	let t = new Blob([H(e)]).stream().pipeThrough(new DecompressionStream("deflate"));
	return new Response(t).arrayBuffer();
}
var W = class e {
	run;
	values;
	path;
	out;
	row;
	places = [];
	constructor(e, t, n, r, i) {
		this.run = e, this.row = i;
		let a = [
			r,
			n.channels.length * n.row,
			(n.outputs + 1) * n.row
		], o = n.heap;
		for (let e of a) this.places.push(o), o = o + 8 * e + 15 & -16;
		o > t.buffer.byteLength && t.grow(Math.ceil((o - t.buffer.byteLength) / 65536)), [this.values, this.path, this.out] = a.map((e, n) => new Float64Array(t.buffer, this.places[n], e));
	}
	static async create(t, n) {
		let { instance: r } = await WebAssembly.instantiate(await ce(t.wasm)), { memory: i, run: a } = r.exports;
		return new e(a, i, t, n, t.row);
	}
	call(e) {
		this.run(this.places[0], this.places[1], this.places[2], Math.ceil(e / 2));
	}
}, G = class {
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
}, le = class e {
	data;
	whole;
	one;
	slope;
	rows;
	row;
	count;
	here;
	cyclic;
	values;
	positions;
	channels;
	constructor(e, t, n, r) {
		this.data = e, this.whole = t, this.one = n, this.slope = r, this.count = e.kernel.count, this.row = e.kernel.row, this.values = t.values, this.values.set(e.numbers.map((e) => e.value)), this.rows = t.out, this.here = new Float64Array(e.kernel.outputs + 1), this.positions = new Map(e.drives.map((e) => [e.name, U(e.position)])), this.channels = new Map(e.channels.map((e) => [e.name, {
			values: U(e.values),
			pieces: e.table && new G(e.table),
			drive: e.table ? e.table.drive : e.name.replace(/^position /, "")
		}])), e.kernel.channels.forEach((e, n) => {
			let r = this.channels.get(e).values;
			for (let e = 0; e < this.row; e++) t.path[n * this.row + e] = r[Math.min(e, this.count - 1)];
		}), this.cyclic = !e.only_at_positions && e.drives.some((e) => e.turns && this.closes(e.name));
	}
	static async create(t) {
		let n = t.numbers.length, r = {
			...t.kernel,
			row: t.kernel.row
		}, [i, a, o] = await Promise.all([
			W.create(t.kernel, n),
			W.create(r, n),
			t.gradient ? W.create(t.gradient, n) : void 0
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
	}
	at(e) {
		this.load(this.one, this.data.kernel.channels, e), this.one.values.set(this.values), this.one.call(1);
		for (let e = 0; e < this.here.length; e++) this.here[e] = this.one.out[e * this.one.row];
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
	good(e) {
		return V.has(this.rows[this.rows.length - this.row + e]);
	}
	get mark() {
		return this.here[this.here.length - 1];
	}
	get finite() {
		return this.here.every(Number.isFinite);
	}
	get solved() {
		return V.has(this.mark);
	}
	value(e, t) {
		return this.rows[e * this.row + t];
	}
};
// src/panels.ts
function ue(e, n, r = !1) {
	let i = t("details", e, { class: "panel" });
	return i.open = r, t("summary", i, {}, n), t("div", i);
}
function de(e, n, r, i) {
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
		let [o, c] = e.parameter ? ["Parameters", e.label] : K(e.label), u = t("label", s(o), { title: e.about ?? e.path });
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
			Number.isFinite(t) && (r.values[n] = t * e.size, i(n, a));
		};
		if (d.addEventListener("change", () => d.value.trim() === "" ? l(f) : p(+d.value, !0)), e.parameter) {
			let [n, r] = e.range ?? q(e.value), i = t("input", u, {
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
function K(e) {
	let t = e.indexOf(": ");
	return t < 0 ? ["Others", e] : [e.slice(0, t), e.slice(t + 2)];
}
function q(e) {
	let t = .5 * Math.abs(e) || 1;
	return [e - t, e + t];
}
function fe(e, n, r) {
	let i = t("tbody", t("table", e, { class: "answers" })), a = n.views.table.map((e) => {
		let r = t("tr", i), a = n.units[e.kind] ?? {
			unit: "",
			size: 1
		};
		return t("th", r, { scope: "row" }, o(e.name)), {
			r: e,
			unit: a,
			cell: t("td", r)
		};
	});
	return { update() {
		for (let { r: e, unit: t, cell: n } of a) {
			let i = e.rows.map((e) => r.here[e] / t.size), a = (e) => t.unit === "°" ? `${P(e, 5)}°` : `${P(e)} ${t.unit}`;
			n.textContent = r.solved ? i.length === 1 ? a(i[0]) : `${a(Math.hypot(...i))}${i.length === 2 ? ` at ${P(Math.atan2(i[1], i[0]) * 180 / Math.PI)}°` : ""}  (${i.map((e) => P(e)).join(", ")})` : "–";
		}
	} };
}
function pe(e, n, r, i) {
	let { terms: a, about: s } = i.equations, c = a[0]?.f.length ?? 2, l = [
		"x",
		"y",
		"z"
	].slice(0, c), u = l.map((e, t) => ({
		head: `ΣF${e}`,
		unit: n.units.force,
		sign: (t) => o(t.name) + e,
		row: (e) => e.f[t]
	}));
	c === 2 ? u.push({
		head: `ΣM about ${s}`,
		unit: n.units.moment,
		sign: (e) => `M(${o(e.name)})`,
		row: (e) => e.m
	}) : l.forEach((e, t) => u.push({
		head: `ΣM${e} about ${s}`,
		unit: n.units.moment,
		sign: (t) => `M${e}(${o(t.name)})`,
		row: (e) => e.m[t]
	}));
	let d = u.map((n) => ({
		sum: n,
		el: t("p", e, { class: "equation" })
	}));
	return { update() {
		for (let { sum: e, el: t } of d) {
			let n = a.map((t) => r.here[e.row(t)] / e.unit.size), i = Math.max(...n.map(Math.abs), 0), o = n.map((e, t) => ({
				v: e,
				k: t
			})).filter((e) => Math.abs(e.v) > 1e-9 * i);
			if (!r.solved || !o.length) {
				t.textContent = `${e.head}: ${r.solved ? "nothing acts" : "no answer here"}`;
				continue;
			}
			let s = o.map((t) => e.sign(a[t.k])).join(" + "), c = o.reduce((e, t) => e + t.v, 0), l = o.map((e, t) => (e.v < 0 ? t ? " − " : "−" : t ? " + " : "") + P(Math.abs(e.v))).join("");
			t.textContent = `${e.head}: ${s} = ${l} = ${P(Math.abs(c) < 1e-9 * i ? 0 : c)} ${e.unit.unit}`;
		}
	} };
}
function me(e, n) {
	t("p", e, {}, "Forces and motion are found by one linear system at each position (D'Alembert's principle); every number drawn here is computed anew from the numbers beside it, in double precision.");
	let r = t("dl", e);
	for (let [e, i] of Object.entries(n.assumptions)) t("dt", r, {}, e), t("dd", r, {}, i);
	n.source && t("p", e, {}, `Source: ${n.source}`), t("p", e, {}, `Made with dalembert ${n.version}.`);
}
// src/page.css?inline
var he = ".dalembert{--ink:#1d2733;--grey:#5b6672;--paper:#fff;--soft:#f4f6f8;--rim:#d5dbe1;--warn:#b3261e;--accent:#1c56a8;color:var(--ink);background:var(--paper);outline:none;font:15px/1.45 system-ui,DejaVu Sans,sans-serif}.dalembert *{box-sizing:border-box}.dalembert [hidden]{display:none!important}.dalembert header{z-index:2;background:var(--paper);border-bottom:1px solid var(--rim);padding:.35em .8em;position:sticky;top:0}.dalembert h1{margin:0;font-size:1.15em;display:inline}.dalembert .bar{flex-wrap:wrap;align-items:center;gap:.5em;margin-top:.25em;display:flex}.dalembert .bar input{min-width:8em;accent-color:var(--accent);flex:1}.dalembert .readout{font-variant-numeric:tabular-nums;min-width:9em}.dalembert button{font:inherit;color:inherit;background:var(--soft);border:1px solid var(--rim);cursor:pointer;border-radius:.4em;padding:.15em .6em}.dalembert button:disabled{opacity:.4;cursor:default}.dalembert .mark{color:var(--warn);min-height:1.45em;margin:.1em 0 0;font-size:.92em}.dalembert main{grid-template-columns:minmax(0,7fr) minmax(0,5fr);align-items:start;gap:.8em;padding:.8em;display:grid}.dalembert .stage{position:sticky;top:6.2em}.dalembert svg{touch-action:pan-y;-webkit-user-select:none;user-select:none;width:100%;height:auto;font-family:DejaVu Sans,Helvetica Neue,Arial,sans-serif;display:block;overflow:hidden}.dalembert .stage svg{touch-action:none;max-height:calc(100vh - 9em)}.dalembert .cloud{pointer-events:none;width:100%;position:absolute;top:0;left:0}.dalembert .switches{color:var(--grey);flex-wrap:wrap;gap:1em;font-size:.9em;display:flex}.dalembert .switches label{cursor:pointer;align-items:center;gap:.3em;display:flex}.dalembert figure{margin:0 0 .4em}.dalembert figcaption{color:var(--grey);font-size:.85em}.dalembert .panel{border-top:1px solid var(--rim);padding:.3em 0}.dalembert summary{cursor:pointer;padding:.15em 0;font-weight:600}.dalembert select{font:inherit;color:inherit;background:var(--soft);border:1px solid var(--rim);border-radius:.4em;max-width:100%}.dalembert .equation{font-variant-numeric:tabular-nums;overflow-wrap:anywhere;margin:.15em 0;font-size:.85em}.dalembert .answers{border-collapse:collapse;font-variant-numeric:tabular-nums;width:100%;font-size:.85em}.dalembert .answers th{text-align:left;padding:.1em .6em .1em 0;font-weight:400}.dalembert .answers td{text-align:right}.dalembert .answers tr+tr>*{border-top:1px solid var(--soft)}.dalembert .polar{width:49%;display:inline-block}.dalembert fieldset{border:0;border-top:1px solid var(--soft);margin:0;padding:.2em 0;font-size:.88em}.dalembert legend{padding:0 .4em 0 0;font-weight:600}.dalembert fieldset label{grid-template-columns:minmax(0,1fr) 7.5em 4.5em;align-items:center;gap:.4em;margin:.1em 0;display:grid}.dalembert fieldset label input[type=range]{accent-color:var(--accent);grid-column:1/-1}.dalembert fieldset input[type=number]{font:inherit;color:inherit;background:var(--soft);border:1px solid var(--rim);border-radius:.3em;width:100%;padding:.05em .3em}.dalembert input.changed{border-color:var(--accent);font-weight:600}.dalembert .unit{color:var(--grey)}.dalembert dl{grid-template-columns:auto 1fr;gap:.1em .8em;font-size:.9em;display:grid}.dalembert dd{margin:0}.dalembert .handle{fill:var(--accent);fill-opacity:.1;stroke:var(--accent);stroke-opacity:.35;stroke-width:.25px;cursor:grab;outline:none}.dalembert .handle:hover,.dalembert .handle:focus-visible{fill-opacity:.3;stroke-opacity:1;outline:none}.dalembert .handle.center{fill:#1a7f4b;stroke:#1a7f4b}.dalembert .handle.load{fill:#c1272d;stroke:#c1272d}.dalembert .handle.direction{fill:#7a2fa0;stroke:#7a2fa0}.dalembert .span *{vector-effect:non-scaling-stroke}.dalembert .cursor{stroke:var(--grey);stroke-width:.3px;fill:none}.dalembert .key{cursor:pointer}.dalembert .key.picked{text-decoration:underline}.dalembert .chart svg{cursor:crosshair}.dalembert [data-link]{cursor:pointer}.dalembert.unsolved svg:not(.chart svg){opacity:.3}@media (max-width:800px){.dalembert main{grid-template-columns:minmax(0,1fr)}.dalembert .stage{position:static}.dalembert .polar{width:100%}}@media (prefers-color-scheme:dark){.dalembert{--ink:#e8edf2;--grey:#9aa7b4;--paper:#151b22;--soft:#222b35;--rim:#323d48;--warn:#ff7b74;--accent:#6fa8f5}}@media print{.dalembert{--ink:#000;--grey:#444;--paper:#fff;--soft:#fff;--rim:#999;--accent:#000}.dalembert header,.dalembert .stage{position:static}.dalembert .bar,.dalembert .switches,.dalembert .handles,.dalembert summary~div>button,.dalembert select{display:none}.dalembert main{display:block}.dalembert figure,.dalembert .panel{break-inside:avoid}}", ge = class {
	b;
	data;
	kernel;
	on = !1;
	arrows;
	constructor(t, n, r) {
		this.b = t, this.data = n, this.kernel = r;
		let i = e("g", t.svg, { class: "gradient" }), a = n.handles.filter((e) => e.kind === "joint" || e.kind === "point");
		this.arrows = n.gradient ? a.map((e) => ({
			h: e,
			arrow: new d(i, "acceleration", `lower the peak by ${e.name}`)
		})) : [];
	}
	update(e) {
		let t = this.data.gradient, n = this.kernel, r = e && t ? t.curves.indexOf(e.row) : -1;
		if (!this.on || r < 0 || !t || !e || !n.solved) return this.arrows.forEach((e) => e.arrow.set([0, 0], [0, 0]));
		let i = 0, a = -1;
		for (let t = 0; t < n.count; t++) n.good(t) && Math.abs(n.value(e.row, t)) > a && (a = Math.abs(n.value(e.row, t)), i = t);
		let o = n.gradient(r, i), s = Math.sign(n.value(e.row, i)) || 1, c = new Map(t.numbers.map((e, t) => [e, o[t]])), l = this.arrows.map(({ h: e }) => {
			let t = 0, r = 0;
			if (e.kind === "joint" || e.kind === "point") for (let i of e.ends) {
				let [e, a] = i.n.map((e) => c.get(e) ?? 0), [o, l] = i.e.map((e) => n.here[e]);
				t -= s * (o * e - l * a), r -= s * (l * e + o * a);
			}
			return [t, r];
		}), u = Math.max(...l.map((e) => Math.hypot(...e)), 1e-300);
		this.arrows.forEach(({ h: e, arrow: t }, n) => {
			let r = this.b.paper.point(e.p), [i, a] = l[n];
			t.set(r, [r[0] + 14 * i / u, r[1] - 14 * a / u], .5);
		});
	}
}, _e = class {
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
		let t = this.canvas, n = this.b.svg.getBoundingClientRect();
		if (t.hidden = !this.on, !this.on || !n.width) return null;
		let r = window.devicePixelRatio || 1, [i, a] = [Math.round(n.width * r), Math.round(n.height * r)];
		(t.width !== i || t.height !== a) && (t.width = i, t.height = a);
		let o = t.getContext("2d"), s = this.b.svg.viewBox.baseVal, c = Math.min(i / s.width, a / s.height);
		o.clearRect(0, 0, i, a), o.fillStyle = "rgba(122,47,160,.25)";
		let l = this.kernel, u = l.values.slice(), d = this.part * this.reach() / 3, f = u.slice(), p = 0, m = 0, h = 0;
		for (let t of this.draws) {
			this.numbers.forEach((e, n) => f[e] = u[e] + d * t[n]), l.other(f, this.out);
			let n = this.out[this.out.length - 1];
			if (n === 0 || n === 9) {
				for (let e of this.places) {
					let [t, n] = this.b.paper.of(...this.b.paper.seen(e, (e) => this.out[e]));
					o.fillRect((t - s.x) * c + (i - s.width * c) / 2, (n - s.y) * c + (a - s.height * c) / 2, r, r);
				}
				e !== void 0 && (p += this.out[e], m += this.out[e] ** 2, h++);
			}
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
}, ve = class {
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
function ye(e, t, n) {
	let r = e.numbers.flatMap((e, n) => t.values[n] === e.value ? [] : [`${encodeURIComponent(e.path)}=${t.values[n]}`]);
	return ["t=" + +n.toFixed(4), ...r].join("&");
}
function be(e, t, n) {
	let r = 0;
	for (let i of n.replace(/^#/, "").split("&")) {
		let [n, a] = i.split("="), o = Number(a);
		if (a && Number.isFinite(o)) {
			if (n === "t") r = o;
			else {
				let r = "";
				try {
					r = decodeURIComponent(n);
				} catch {
					continue;
				}
				let i = e.numbers.findIndex((e) => e.path === r);
				i >= 0 && (t.values[i] = o);
			}
		}
	}
	return r;
}
function xe(e, t) {
	return e.template.map((e, n) => n % 2 ? String(t.values[+e]) : e).join("");
}
function Se(e, t) {
	let n = (e) => /[",\n]/.test(e) || /^[=+\-@]/.test(e) ? `"${e.replace(/^([=+\-@])/, "'$1").replace(/"/g, "\"\"")}"` : e, r = e.views.charts.flatMap((t) => t.curves.map((n) => ({
		x: n,
		unit: e.units[t.kind] ?? {
			unit: "",
			size: 1
		}
	}))), i = [[
		...e.drives.map((e) => `${e.name} [${e.unit}]`),
		"status",
		...r.map(({ x: e, unit: t }) => `${e.of} [${t.unit}]`)
	].map(n).join(",")];
	for (let a = 0; a < t.count; a++) {
		let o = t.good(a), s = String(t.rows[t.rows.length - t.row + a]), c = e.drives.map((e) => t.positions.get(e.name)[a] / e.size);
		i.push([
			...c,
			n(e.statuses[s]?.status ?? "ok"),
			...r.map(({ x: e, unit: n }) => o ? t.value(e.row, a) / n.size : "")
		].join(","));
	}
	return i.join("\n") + "\n";
}
function Ce(t, n) {
	let r = t.cloneNode(!0), { width: i, height: a } = t.viewBox.baseVal;
	r.querySelectorAll(".handles").forEach((e) => e.remove()), r.setAttribute("xmlns", "http://www.w3.org/2000/svg"), r.setAttribute("width", `${i}mm`), r.setAttribute("height", `${a}mm`), r.setAttribute("font-family", "'DejaVu Sans', Arial, sans-serif");
	let o = e("style", null);
	return o.textContent = n, r.prepend(o), new XMLSerializer().serializeToString(r);
}
function J(e, t, n) {
	let r = document.createElement("a");
	r.href = URL.createObjectURL(new Blob([t], { type: n })), r.download = e, r.click(), setTimeout(() => URL.revokeObjectURL(r.href), 1e3);
}
var we = (e) => o(e).toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "").slice(0, 60) || "mechanism";
// src/page.ts
async function Y(e, n, r = {}) {
	if (n.format !== "dalembert-page/1") throw Error(`this page cannot show data of the form ${n.format}`);
	let i = await le.create(n), a = document.createElement("div");
	a.className = "dalembert", i.cycle();
	let s = t("style", a);
	s.textContent = he + n.style.light + `@media (prefers-color-scheme:dark){${n.style.dark}}@media print{` + n.style.light + "}";
	let c = new ve(i), l = [], u = r.address ? be(n, i, location.hash) : 0;
	c.note();
	let d = t("header", a), f = t("main", a);
	t("h1", d, {}, n.title);
	let p = t("div", d, {
		class: "bar",
		role: "toolbar",
		"aria-label": "cycle and page"
	}), m = (e, n, r) => {
		let i = t("button", p, {
			type: "button",
			title: n,
			.../^\w/.test(e) ? {} : { "aria-label": n }
		}, e);
		return i.addEventListener("click", r), i;
	}, h = m("▶", "play along the cycle (space)", () => Te()), g = t("input", p, {
		type: "range",
		min: 0,
		max: i.end,
		step: n.only_at_positions ? 1 : "any",
		"aria-label": "place of the cycle"
	}), _ = t("output", p, { class: "readout" }), v = m("↶", "undo (Ctrl+Z)", () => Z(!0)), y = m("↷", "redo (Ctrl+Y)", () => Z(!1));
	m("Reset", "all numbers as in the file", () => {
		i.values.set(n.numbers.map((e) => e.value)), X([]), Y();
	});
	let b = t("p", d, {
		class: "mark",
		role: "status"
	});
	for (let e of [
		h,
		g,
		_
	]) e.hidden = i.count < 2;
	let x = t("section", f, {
		class: "stage",
		"aria-label": "mechanism"
	}), S = M(x, i, n.views.mechanism, null, 170, A(i, n.views.mechanism, 170), n.units, "the mechanism"), C = n.views.charts.flatMap((e) => e.curves).find((e) => n.gradient?.curves.includes(e.row)), w = new ge(S, n, i), T = new _e(x, S, n, i, n.handles.flatMap((e) => e.kind === "joint" || e.kind === "point" ? [e.p] : [])), E = ie(S, n, i, {
		changed: () => Y(),
		finished: X,
		seek: (e) => Q(e),
		time: () => u
	}, () => S.force()), D = t("div", x, { class: "switches" }), O = (e, n, r, i) => {
		let a = t("label", D, { title: n }), o = t("input", a, { type: "checkbox" });
		return o.checked = r, a.append(e), o.addEventListener("change", () => (i(o.checked), $(!0))), o;
	};
	O("names", "names of joints", S.names, (e) => S.names = e), n.gradient && O("what lowers the peak", "arrows: moving a joint this way lowers the peak of the chosen curve", !1, (e) => w.on = e), n.handles.some((e) => e.kind === "joint") && O("tolerances", "a thousand machines with points up to 0.5 % of the drawing's width off", !1, (e) => T.on = e);
	let k = t("span", D, { class: "spread" }), j = t("section", f, {
		class: "side",
		"aria-label": "results"
	}), ee = (e) => Q(e), te = (e) => (C = e, $(!0)), N = [...i.count > 1 ? n.views.charts.map((e) => ne(j, n, i, e, () => u, ee, te, () => C)) : []], I = t("select", U("Free body", !0), { "aria-label": "link" });
	n.views.bodies.forEach((e, n) => t("option", I, { value: n }, `${e.title}${e.member && `, ${e.member} member`}`));
	let ae = t("div", I.parentElement), L = n.views.bodies.map((e) => {
		let r = t("div", ae, { class: "body" });
		return {
			box: r,
			drawn: M(r, i, e, e.about, 110, 100, n.units, `free body of ${e.title}`),
			sums: pe(r, n, i, e)
		};
	}), R = n.views.polygons.links.length ? U("Force polygon") : t("div", null), oe = n.views.polygons.links.map((e) => re(R, n, i, e)), z = i.count > 2 ? n.views.charts.flatMap((e) => e.curves).filter((e) => e.f) : [], B = z.length ? U("Polar diagrams") : null, se = B ? z.map((e) => F(B, i, e, n.units.force)) : [], V = fe(U("Numbers of this position"), n, i), H = de(U("Change numbers", n.numbers.some((e) => e.parameter)), n, i, (e, t) => {
		Y(), t && X([e]);
	});
	me(U("Method and assumptions"), n), ce();
	function U(e, t = !1) {
		return ue(j, e, t);
	}
	function ce() {
		let e = U("Save and share"), a = we(n.title), o = (n, r) => t("button", e, { type: "button" }, n).addEventListener("click", r);
		o("Model file", () => J(`${a}.yaml`, xe(n, i), "text/yaml")), o("Curves as CSV", () => J(`${a}.csv`, Se(n, i), "text/csv")), o("Drawing as SVG", () => J(`${a}.svg`, Ce(S.svg, n.style.light), "image/svg+xml")), o("Print", () => window.print()), r.address && o("Copy link", () => {
			location.hash = ye(n, i, u), navigator.clipboard?.writeText(location.href);
		});
	}
	I.addEventListener("change", () => $(!1)), S.svg.addEventListener("click", (e) => {
		let t = e.target.closest("[data-link]")?.dataset.link, r = n.views.bodies.findIndex((e) => e.link === t);
		r >= 0 && (I.value = String(r), $(!1));
	}), g.addEventListener("input", () => Q(+g.value)), n.views.mechanism.arrows.concat(...n.views.bodies.map((e) => e.arrows)).some((e) => e.p.length > 2) && W();
	function W() {
		let e = [S, ...L.map((e) => e.drawn)];
		t("span", D, {}, "drag to look from elsewhere");
		for (let t of e) t.svg.style.cursor = "move", t.svg.addEventListener("pointerdown", (e) => t.svg.setPointerCapture(e.pointerId)), t.svg.addEventListener("pointermove", (n) => {
			if (t.svg.hasPointerCapture(n.pointerId)) {
				for (let t of e) t.paper.azimuth -= .01 * n.movementX, t.paper.elevation = Math.min(Math.max(t.paper.elevation + .01 * n.movementY, -1.55), 1.55), t.fit();
				$(!0);
			}
		});
	}
	let G = 0, K = !0, q = 0;
	function Y() {
		$(!0);
	}
	function X(e) {
		c.note(), S.fit(), $(!0), H.update(), r.edited && e.length && r.edited(Object.fromEntries(e.map((e) => [n.numbers[e].path, i.values[e]]))), r.address && window.history.replaceState(null, "", "#" + ye(n, i, u));
	}
	function Z(e) {
		c.go(e) && ($(!0), H.update(), r.edited?.(Object.fromEntries(n.numbers.map((e, t) => [e.path, i.values[t]]))));
	}
	function Q(e) {
		u = Math.min(Math.max(e, 0), i.end), n.only_at_positions && (u = Math.round(u)), $(!1);
	}
	function Te() {
		if (q) return Ee();
		h.textContent = "❚❚";
		let e = performance.now(), t = (r) => {
			let a = u + (r - e) / 1e3 / 6 * i.end;
			e = r, Q(a >= i.end ? 0 : a), (!n.only_at_positions || a >= 1) && (q = requestAnimationFrame(t));
		};
		q = requestAnimationFrame(t);
	}
	function Ee() {
		cancelAnimationFrame(q), q = 0, h.textContent = "▶";
	}
	function $(e) {
		K ||= e, G ||= requestAnimationFrame(() => {
			G = 0;
			let e = performance.now();
			De(), l.push(performance.now() - e), l.length > 2e3 && l.shift();
		});
	}
	function De() {
		let e = K;
		K = !1, e && i.cycle(), i.at(u);
		let t = i.solved, r = n.statuses[String(i.mark)];
		a.classList.toggle("unsolved", !t), b.textContent = r && i.mark ? r.sentence : "", S.update(e), E(), w.update(C);
		let o = T.update(C?.row);
		k.textContent = o && C ? ke(o, C) : "", N.forEach((t) => t.update(e));
		let s = +I.value;
		L.forEach((t, n) => {
			t.box.hidden = n !== s, n === s && Oe(t.box) && (t.drawn.update(e), t.sums.update());
		}), oe.forEach((t, n) => {
			t.figure.hidden = n !== s, n === s && Oe(t.figure) && t.update(e);
		}), se.forEach((t) => t.update(e)), Oe(R), V.update(), g.value = String(u), _.textContent = n.drives.map((e) => `${e.name} = ${P(i.position(e.name, u) / e.size, 5)}${e.unit === "°" ? "" : " "}${e.unit}`).join(", "), [v.disabled, y.disabled] = c.can.map((e) => !e);
	}
	let Oe = (e) => e.closest("details")?.open ?? !0;
	function ke(e, t) {
		let r = n.views.charts.find((e) => e.curves.includes(t)).kind, i = n.units[r] ?? {
			unit: "",
			size: 1
		};
		return `${o(t.name)}: ${P(e.mean / i.size)} ± ${P(e.sigma / i.size, 2)} ${i.unit} (1 σ)`;
	}
	return a.querySelectorAll("details").forEach((e) => e.addEventListener("toggle", () => $(!0))), a.addEventListener("keydown", (e) => {
		let t = /INPUT|SELECT|TEXTAREA/.test(e.target.tagName);
		(e.ctrlKey || e.metaKey) && !t && /^[zy]$/i.test(e.key) ? (e.preventDefault(), Z(e.key.toLowerCase() === "z" && !e.shiftKey)) : e.key === " " && !t && e.target.tagName !== "BUTTON" && i.count > 1 && (e.preventDefault(), Te());
	}), a.tabIndex = -1, i.cycle(), i.at(u), e.replaceChildren(a), S.fit(), De(), H.update(), {
		kernel: i,
		data: n,
		times: l,
		show: Q,
		set(e, t) {
			let r = n.numbers.findIndex((t) => t.path === e);
			if (r < 0) throw Error(`there is no number ${e}`);
			i.values[r] = t, X([]);
		},
		text: () => xe(n, i),
		remove: () => (Ee(), a.remove())
	};
}
// src/main.ts
var X = { async render({ model: e, el: t }) {
	let n = (t) => {
		e.set("changes", {
			...e.get("changes"),
			...t
		}), e.save_changes();
	}, r = await Y(t, e.get("data"), { edited: n }), i = async () => {
		r.remove(), r = await Y(t, e.get("data"), { edited: n });
	};
	return e.on("change:data", i), () => (e.off("change:data", i), r.remove());
} };
export { X as default, Y as mount };
