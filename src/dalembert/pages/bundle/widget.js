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
	let t = Math.round(100 * Math.abs(e)), n = Math.floor(t / 100), r = t % 100;
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
// src/labels.ts
var g = [
	[1, -1],
	[-1, -1],
	[1, 1],
	[-1, 1],
	[0, -1],
	[1, 0],
	[-1, 0],
	[0, 1]
], _ = [
	1,
	1.9,
	3,
	4.5
];
function v(e, t, n, r) {
	return {
		el: p(e, t, n, r),
		text: n,
		size: r,
		bold: t === "title",
		choice: -1
	};
}
var y = class {
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
		for (let [o, d] of e.anchors) for (let f of _) for (let [p, m] of g) {
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
		for (let n of this.texts) b(e, n) > 0 && (t += 60 + 5 * b(e, n));
		for (let n of this.discs) b(e, n) > 0 && (t += 8 + b(e, n));
		for (let [n, r] of this.lines) x(e, n, r) && (t += 6);
		let [n, r, i, a] = this.bounds;
		return (e[0] < n || e[1] < r || e[2] > i || e[3] > a) && (t += 20), t;
	}
};
function b(e, t) {
	let n = Math.min(e[2], t[2]) - Math.max(e[0], t[0]), r = Math.min(e[3], t[3]) - Math.max(e[1], t[1]);
	return n > 0 && r > 0 ? n * r : 0;
}
function x(e, t, n) {
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
var S = (e, t, n) => t.reduce((t, r, i) => t + e[i] * n(r), 0), C = class {
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
		return e.length < 3 ? [t(e[0]), t(e[1])] : [S(this.axes[0], e, t), S(this.axes[1], e, t)];
	}
	depth(e) {
		return S(this.axes[2], e, (e) => this.kernel.here[e]);
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
function w(n, i, o) {
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
	if (i.t === "pair") return T(n, i, o);
	let c = t("path", n, {
		class: `l-${i.role}`,
		style: "fill:none"
	});
	if (i.t === "trace") return { update: () => c.setAttribute("d", E(o.kernel, (e) => o.pointAt(i.p[0], e), !0)) };
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
function T(e, n, i) {
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
function E(e, t, n = !1) {
	let i = n && e.cyclic ? e.count : e.count - 1, a = "", o = !1;
	for (let n = 0; n <= i; n++) {
		let i = n % e.count, s = !!e.good[i];
		if (s) {
			let [n, s] = t(i);
			if (a += (o ? "L" : "M") + r(n) + " " + r(s), e.reverses(i)) {
				let [n, o] = e.onceAfter(() => t(i));
				a += "L" + r(n) + " " + r(o);
			}
		}
		o = s;
	}
	return a;
}
function D(e, t, n, r, i) {
	return t.t === "couple" ? j(e, t, n) : k(e, t, n, r, i);
}
var O = 13;
function k(e, t, n, r, i) {
	let a = new m(e, t.role, t.name), o = t.t === "force" ? null : new m(e, t.role), s = t.t === "force" ? t.f : t.m, c = v(e, t.role, t.name, 3.4), l = [0, 0], u = [0, 0], d = [0, 0], f = !1;
	return {
		label: c,
		update() {
			let e = n.point(t.p), [p, m] = n.here(s), h = o ? Math.hypot(...s.map((e) => n.kernel.here[e])) / O || 1 : r(), g = [p / h, -m / h], _ = !1;
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
var A = 4.6;
function j(e, n, i) {
	let a = i.kernel.here, o = t("g", e), s = v(e, n.role, n.name, 3.4);
	t("title", o).textContent = l(n.name), t("path", o, {
		class: `l-${n.role}`,
		style: "fill:none",
		d: "M4.17 1.94A4.6 4.6 0 1 0 -4.17 1.94"
	}), t("path", o, {
		class: `l-${n.role}-h`,
		d: "M-4.17 2.9L-5.6 -0.1L-3 0.3Z"
	});
	let c = !1;
	return {
		label: s,
		update() {
			let [e, t] = i.point(n.p), l = a[n.m[0]];
			c = Number.isFinite(l) && Math.abs(l) > 1e-9, o.setAttribute("display", c ? "inline" : "none"), s.el.setAttribute("visibility", c ? "visible" : "hidden"), o.setAttribute("transform", `translate(${r(e)} ${r(t)}) scale(${l < 0 ? -1 : 1} 1)`);
		},
		mark(e) {
			c && e.disc(i.point(n.p), A);
		},
		anchor() {
			let [e, t] = i.point(n.p);
			return c ? [
				[e, t - A],
				[e - A, t],
				[e + A, t],
				[e, t + A],
				[0, -1]
			] : null;
		}
	};
}
// src/board.ts
var M = [
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
function N(e) {
	if (!(e > 0) || !Number.isFinite(e)) return 1;
	let t = 10 ** Math.floor(Math.log10(e) + 1e-12);
	return t * (M.find((n) => n * t >= e * (1 - 1e-12)) ?? 10);
}
function P(e) {
	let t = 10 ** Math.floor(Math.log10(e) + 1e-12);
	return t * ([5, 2].find((n) => n * t <= e * (1 + 1e-12)) ?? 1);
}
function F(e) {
	let t = (e) => [Math.min(...e), Math.max(...e)], n = t(e.map((e) => e[0])), r = t(e.map((e) => e[1]));
	return Number.isFinite(n[0] + n[1] + r[0] + r[1]) ? {
		x: n,
		y: r
	} : null;
}
var I = (e) => e.t === "hull" || e.t === "path" ? e.p : e.t === "symbol" || e.t === "pair" ? [e.p] : [];
function L(e, t) {
	let n = e.kernel, r = Math.max(1, Math.floor(n.count / 72)), i = [];
	for (let a of t.items.flatMap(I)) for (let t = 0; t < n.count; t += r) n.good[t] && i.push(e.seen(a, (e) => n.value(e, t)));
	return F(i);
}
var R = (e) => e.items.some((e) => e.t === "pair"), z = class {
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
		let u = P(26 * c), d = t + u / c, p = `${i(u)} ${s.unit}`, m = `M${r(t)} ${r(n - 1)}v2`, h = this.arrow ? `M${r(d - 2.4)} ${r(n - .8)}L${r(d)} ${r(n)}L${r(d - 2.4)} ${r(n + .8)}` : `M${r(d)} ${r(n - 1)}v2`;
		return this.line.setAttribute("d", m + a([[t, n], [d, n]]) + h), e(this.text, {
			x: r(d + 1.4),
			y: r(n + 1)
		}).textContent = p, d + 1.4 + f(p, 2.8);
	}
};
function B(e, n, r, i) {
	return t("svg", e, {
		viewBox: `${-n / 2} ${-r / 2} ${n} ${r}`,
		role: "group",
		"aria-label": i
	});
}
function V(e, n, r, i, a, o, s, c) {
	let l = {
		length: s.length.size,
		force: s.force.size
	}, u = B(e, a, o, c), d = new C(n, r.per_mm, R(r)), f = [], p = [], m = r.force;
	r.middle && (d.middle = r.middle);
	let h = t("g", u), g = t("g", u), _ = t("g", u);
	for (let e of r.items) (e.t === "trace" ? f : p).push(w(h, e, d));
	let b = r.arrows.map((e) => D(g, e, d, () => m, i ?? void 0)), x = r.labels.map((e) => ({
		l: v(_, e.role, e.text, e.kind === "joint" ? 3.8 : 3.3),
		p: e.p,
		q: e.q
	})), S = new z(_), T = new z(_, !0), E = r.arrows.filter((e) => e.t === "force"), O = Math.max(1, Math.floor(n.count / 72));
	function k(e) {
		e && (d.middle = [(e.x[0] + e.x[1]) / 2, (e.y[0] + e.y[1]) / 2]);
	}
	let A = i ? [
		...i,
		...r.arrows.map((e) => e.p),
		...r.items.flatMap((e) => e.t === "symbol" ? [e.p] : [])
	] : [], j = r.items.flatMap((e) => {
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
	function M(e) {
		let t = j.flatMap(({ p: t, reach: n }) => [-1, 1].map((r) => d.seen(t, e).map((t) => t + r * n(e))));
		return F([...A.map((t) => d.seen(t, e)), ...t]);
	}
	function P() {
		return Array.from({ length: Math.ceil(n.count / O) }, (e, t) => t * O).flatMap((e) => {
			let t = n.good[e] ? M((t) => n.value(t, e)) : null;
			return t ? [{
				k: e,
				b: t
			}] : [];
		});
	}
	function I() {
		let e = n.largest((e) => Math.max(0, ...E.map((t) => Math.hypot(...t.f.map((t) => n.value(t, e)))))) / (i ? 26 : Math.min(Math.max(.18 * Math.min(a, 1.3 * o), 16), 40));
		for (let { k: t, b: r } of i ? P() : []) for (let i of E) {
			let s = (e) => n.value(e, t), c = d.seen(i.p, s), l = d.seen(i.f, s);
			[a / 2 - 9, o / 2 - 12].forEach((t, n) => {
				let i = n ? (r.y[0] + r.y[1]) / 2 : (r.x[0] + r.x[1]) / 2, a = t - Math.abs(c[n] - i) / d.perMm;
				e = Math.max(e, Math.abs(l[n]) / Math.max(a, 4));
			});
		}
		return e > 0 ? N(e / l.force) * l.force : m;
	}
	function V(e) {
		let t = i ? P().map(({ b: e }) => e) : [L(d, r)].filter((e) => e !== null), n = i ? [46, 40] : [a - Math.max(.22 * a, 34), o - Math.max(.22 * o, 30)], s = Math.max(0, ...t.flatMap((e) => [(e.x[1] - e.x[0]) / n[0], (e.y[1] - e.y[0]) / n[1]]));
		!i && t.length && k(t[0]), s > 0 && (d.perMm = N(s / l.length) * l.length), m = e ?? I();
	}
	function H() {
		let e = new y([
			-a / 2,
			-o / 2,
			a / 2,
			o / 2 - 6
		]);
		for (let t of [...p, ...b]) t.mark?.(e);
		for (let { l: t, p: n, q: r } of x) {
			let i = U.names || !!r;
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
	let U = {
		svg: u,
		paper: d,
		fit: V,
		need: I,
		force: () => m,
		names: r.labels.filter((e) => e.kind === "joint").length <= 8,
		resize(e, t) {
			[a, o] = [e, t], u.setAttribute("viewBox", `${-a / 2} ${-o / 2} ${a} ${o}`);
		},
		update(e) {
			e && f.forEach((e) => e.update()), g.setAttribute("visibility", n.solved ? "visible" : "hidden");
			let t = o / 2 - 2.6, r = S.set([-a / 2 + 2, t], d.perMm, s.length);
			if (T.set([r + 5, t], E.length ? m : NaN, s.force), n.finite) {
				i && k(M((e) => n.here[e]));
				for (let e of [...p, ...b]) e.update();
				H();
			}
		}
	};
	return U;
}
// src/gap.ts
function H(n, o, s) {
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
				said: `${e.joint} misses by ${i(Math.hypot(...e.p.map((t, n) => t - e.q[n])) / u, 3)} ${l}`
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
// src/reading.ts
var U = class extends Error {}, W = (e, t) => e.replace(/\{(\w+)\}/g, (e, n) => t[n] ?? e);
function G(e) {
	if (/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(e)) return e;
	let t = e.includes("'") && !e.includes("\"") ? "\"" : "'", n = t + e.replace(/\\/g, "\\\\") + t;
	return n.length <= 60 ? n : n.slice(0, 57) + "...";
}
var K = {
	"²": "^2",
	"³": "^3",
	"·": "*",
	"⋅": "*",
	"×": "*",
	"−": "-"
}, ee = class {
	text;
	reading;
	units;
	tokens;
	constructor(e, t, n) {
		this.text = e, this.reading = t, this.units = n;
		let r = e.replace(/[²³·⋅×−]/g, (e) => K[e]).replaceAll("**", "^");
		r = r.replace(/\b(ft|in)-lb\b/g, "$1*lbf").replace(/\blb-(ft|in)\b/g, "lbf*$1").replace(/(?<=[a-zµμ])[-.](?=[a-zµμ])/gi, "*"), this.tokens = r.match(/\d+|[a-zµμ_]+|[°%]|[-*/^()]|\S/gi) ?? [];
	}
	read() {
		let e = this.product(1);
		return this.tokens.length && this.refuse(`unexpected ${G(this.tokens[0])}`), e;
	}
	refuse(e) {
		throw new U(W(this.reading.sentences.form, {
			unit: G(this.text),
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
		else return this.refuse(r === void 0 ? "a name is missing" : `expected a name, not ${G(r)}`);
		let a = 1;
		if (this.tokens[0] === "^") {
			this.tokens.shift();
			let e = this.tokens[0] === "-" && this.tokens.shift() !== void 0, t = this.tokens.shift() ?? "";
			if (!/^[1-6]$/.test(t)) throw new U(W(this.reading.sentences.power, { unit: G(this.text) }));
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
		if (!t) throw new U(W(this.reading.sentences.no_unit, {
			unit: G(e),
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
function te(e, t, n) {
	let { kinds: r, sentences: i } = n, a = r[t.kind] ?? r.number, o = e.trim(), s = /^([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)\s*(.*)$/is.exec(o.replaceAll("−", "-")), c = {
		text: G(o),
		phrase: a.phrase,
		remedy: a.remedy
	}, l = (e, t = {}) => {
		throw new U(W(e, {
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
	let p = new ee(d, n, a.units).read(), m = [...p.dimension];
	if (a.per_radian && m[3] === 0 && (m[3] = a.dimension[3]), m.some((e, t) => e !== a.dimension[t])) {
		let e = Object.values(r).find((e) => e.dimension.every((e, t) => e === p.dimension[t]))?.phrase ?? ne(p.dimension);
		if (/\blb\b/.test(d) && a.force) return l(i.dimension, {
			given: e,
			remedy: W(i.pounds.split("; ")[1], { unit: d.replaceAll("lb", "lbf") })
		});
		let n = t.kind === "angular_speed" && String(p.dimension) === "0,0,-1,0";
		return l(i.dimension, {
			given: e,
			...n ? { remedy: i.hertz.split("; ").slice(1).join("; ") } : {}
		});
	}
	return f(+u * p.up / p.down);
}
function ne(e) {
	return `in ${[
		"m",
		"kg",
		"s",
		"rad"
	].flatMap((t, n) => e[n] ? [t + (e[n] === 1 ? "" : `^${e[n]}`)] : []).join("*")}`;
}
// src/gate.ts
var re = class {
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
			let r = te(t, n, this.data.reading);
			this.check(n, r, G(t.trim())), this.kernel.values[e] = r;
		} catch (e) {
			if (!(e instanceof U)) throw e;
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
		if (!Number.isFinite(t)) throw new U(W(r.finite, { text: n }));
		if (e.sign && (t < 0 || e.sign === "positive" && t === 0)) throw new U(W(i[e.sign], { text: n }));
		if (a && t !== e.value && (t < a[0] || t > a[1])) throw new U(W(r.range, {
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
				return `${r.slice(0, a)}: ${r.slice(a + 1)}: ${W(t.signs[i], { text: n })}`;
			}
		}
		return "";
	}
	words(e, t) {
		return `${i(t / e.size, 6).replace("–", String(t))}${e.unit === "°" ? "" : " "}${e.unit}`.trim();
	}
};
// src/handles.ts
function ie(e, n, r, i) {
	let a = t("g", e.svg, { class: "handles" }), o = n.handles.map((t) => oe(a, e, t, r, i));
	return ce(e, n, r, i), () => r.finite && o.forEach((e) => e());
}
var q = (e, t) => e.reduce((e, n, r) => e + n * t[r], 0);
function ae(e, t, n, r, [i, a]) {
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
function oe(n, i, a, o, c) {
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
		"data-name": a.name
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
		if ("by" in a && a.by) ae(o, d, a.p, a.by, d.metres(e));
		else if ("ends" in a) E(a.ends, T(C(e)));
		else if (a.kind === "direction") {
			let t = d.point(a.p), n = [e[0] - t[0], t[1] - e[1]], [r, i] = m[0].axes.map((e) => q(e, n));
			f[a.direction] = se(Math.atan2(i, r), f[a.direction]);
		} else D(a, C(e).map((e, t) => _[t] + e / d.perMm * i.force()));
		c.changed();
	}, T = (e) => {
		if (!("about" in a) || !a.about) return e;
		let t = v, n = h.map((e, n) => e - t[n]), r = n.map((t, n) => t + e[n]), i = Math.hypot(...n) / (Math.hypot(...r) || 1);
		return r.map((e, n) => t[n] + i * e - h[n]);
	}, E = (e, t) => e.forEach((e, n) => {
		let r = h.map((e, r) => e + t[r] - m[n].at[r]);
		e.n.forEach((e, t) => f[e] = q(m[n].axes[t], r));
	}), D = (e, t) => {
		let n = m[0].axes.map((e) => q(e, t));
		if (e.components) return e.components.forEach((e, t) => f[e] = n[t]);
		let r = Math.sign(f[e.size]) || 1;
		e.direction === void 0 ? f[e.size] = r * q(t, _) / (Math.hypot(..._) || 1) : (f[e.direction] = se(Math.atan2(r * n[1], r * n[0]), f[e.direction]), f[e.size] = r * Math.hypot(...n));
	}, O = () => {
		b && c.finished(), b = !1;
	};
	return u.addEventListener("pointerdown", (e) => {
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
var se = (e, t) => e - 2 * Math.PI * Math.round((e - t) / (2 * Math.PI));
function ce(e, t, n, r) {
	let i = t.drives[0];
	if (!i || n.count < 2 || !(i.turns || i.along) || i.p.length > 2) return;
	let a = 0, o = 0, c = !1, l = (t) => {
		let n = s(e.svg, t), r = e.paper.point(i.p);
		return i.along ? q(e.paper.metres(n), e.paper.here(i.along)) : Math.atan2(r[1] - n[1], n[0] - r[0]);
	};
	e.svg.addEventListener("pointerdown", (t) => {
		t.target.closest("[data-link]")?.dataset.link === i.link && (e.svg.setPointerCapture(t.pointerId), [a, o, c] = [
			l(t),
			r.time(),
			!0
		]);
	}), e.svg.addEventListener("pointermove", (e) => {
		if (!c) return;
		let t = (n.position(i.name, n.count - 1) - n.position(i.name, 0)) / (n.count - 1), s = l(e), u = o + (i.turns ? se(s - a, 0) : s - a) / t;
		n.cyclic && (u = (u % n.count + n.count) % n.count), [a, o] = [s, u], r.seek(u);
	}), e.svg.addEventListener("pointerup", () => c = !1);
}
// src/sketch.ts
var le = 1e-9, ue = 1e-12, de = .25, fe = 1e-13, pe = 1e-9, me = 1e5, he = 1e3, ge = .05, _e = 1e-5, J = (e) => ({
	point: e.point.slice(),
	rotation: e.rotation.slice(),
	turn: e.turn.slice()
}), ve = class {
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
		}), this.cholesky();
		let s = 0;
		for (let e of n) s = Math.max(s, Math.abs(e));
		return Number.isFinite(s) ? s : Infinity;
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
		let { n, data: r, right: i } = this, a = r.dimension, o = J(e);
		return r.links.forEach((e, s) => {
			let c = n * this.place[s];
			for (let e = 0; e < a; e++) o.point[a * s + e] += t * r.length * i[c + e];
			a === 2 ? (o.turn[s] += t * i[c + 2], o.rotation[2 * s] = Math.cos(o.turn[s]), o.rotation[2 * s + 1] = Math.sin(o.turn[s])) : xe(o.rotation, 9 * s, t * i[c + 3], t * i[c + 4], t * i[c + 5]);
		}), r.turns.length && (this.evaluate(o), r.turns.forEach((e, t) => o.turn[t] = this.program.at(e))), o;
	}
	correct(e, t = Infinity, n = 12, r = pe) {
		let i = this.gap(e), a = 0, o = 0;
		for (let s = 0; s < n; s++) {
			if (i <= ue) return {
				pose: e,
				first: a,
				rest: o
			};
			if (!Number.isFinite(i)) return null;
			let n = this.solve(r);
			if (s ? o += n : a = n, !(a + o <= t)) return null;
			let c = this.moved(e, Math.min(1, de / n)), l = this.gap(c);
			if (l <= le && l > .5 * i) return {
				pose: l < i ? c : e,
				first: a,
				rest: o
			};
			[e, i] = [c, l];
		}
		return i <= le ? {
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
			let t = this.correct(r, .5, 12, fe), n = this.apart(r, e.pose);
			if (t && t.first + t.rest <= .1 * n + 1e-7) return t.pose;
		}
		let i = this.correct(e.pose, .6, 10, e.stations > 1 ? fe : pe);
		return i && i.first <= .5 && i.rest <= .15 * i.first + 1e-9 && !(r && i.first > 3 * this.apart(r, e.pose) + 1e-6) ? i.pose : null;
	}
	loosen(e, t, n) {
		return this.least(e, t, (e) => e.joint === n && e.kind === "constraint" ? 1 : me, 60);
	}
	open(e, t) {
		let { n, right: r, data: i } = this, a = i.dimension, o = /* @__PURE__ */ new Map();
		r.fill(0), i.links.forEach((e, t) => {
			for (let e = a; e < n; e++) r[n * this.place[t] + e] = ge * Math.cos(t * (n - a) + e - a);
		});
		let s = this.least(this.moved(e, 1), t, (e) => e.kind === "freedom" ? he * he : 1, 300, Infinity, 1);
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
		})), o = a.filter(({ r: e }) => e.kind !== "freedom"), s = a.filter(({ k: e }) => t.drives.includes(e)), c = ye([...o, ...s].map(({ j: e }) => [...e]), n), l = (e) => c.some((t) => Math.abs(t.reduce((t, n, r) => t + n * e[r], 0)) > 1e-6);
		return {
			freedoms: ye(o.map(({ j: e }) => [...e]), n).length,
			links: t.links.filter((e, t) => c.some((e) => e.slice(r * this.place[t], r * this.place[t] + r).some((e) => Math.abs(e) > 1e-6))),
			joints: a.flatMap(({ r: e, j: t }) => e.kind === "freedom" && l(t) ? [e] : [])
		};
	}
	least(e, t, n, r, i = de, a = .001) {
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
function ye(e, t) {
	let n = Array.from({ length: t }, (e, t) => t), r = [], i = Math.max(0, ...e.flat().map(Math.abs));
	for (let a = 0; a < Math.min(e.length, t); a++) {
		let o = 0, s = a, c = a;
		for (let r = a; r < e.length; r++) for (let i = a; i < t; i++) Math.abs(e[r][n[i]]) > o && ([o, s, c] = [
			Math.abs(e[r][n[i]]),
			r,
			i
		]);
		if (!(o > _e * i)) break;
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
var be = class {
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
function xe(e, t, n, r, i) {
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
var Se = 8, Ce = 120, we = .3, Te = 2 ** -7, Ee = class {
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
	channels;
	constructor(e, t, n, r, i, a) {
		this.kernel = t, this.shown = r, this.values = i, this.inputs = a;
		let o = this.data = e.sketch;
		this.sketch = new ve(o, n), this.count = e.kernel.count, this.poses = Array(this.count).fill(null), this.branches = o.branches.map(() => new Float64Array(this.count).fill(1)), this.model = new Float64Array(o.branches.length).fill(1), this.phases = o.rows.flatMap((e, t) => e.kind === "phase" ? [t] : []);
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
		}, this.weakest = ke(o);
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
		let t = Ae(this.data, this.held.pose, e), { sketch: n } = this;
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
		if (this.seen?.every((e, t) => e === this.values[t])) return;
		this.seen = this.values.slice();
		let e = this.reclose();
		this.poses.fill(null), e && this.follow(this.held.t, this.held.pose), this.settle(e);
	}
	reclose() {
		let e = this.values, t = this.kernel.drives(this.held.t), { sketch: n } = this;
		if (this.loose) {
			n.values = e;
			let t = n.close(this.loose.pose, this.kernel.drives(this.loose.t), we);
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
			let c = n.close(this.held.pose, t, we);
			if (c) this.held = {
				values: s,
				t: this.held.t,
				pose: c
			}, [a, i] = [o, Math.min(1, 2 * i)];
			else if ((i /= 2) < Te) return !1;
		}
		return !0;
	}
	follow(e, t) {
		let { course: n, cycle: r } = this.data, i = this.count;
		this.sketch.values = this.values;
		let a = this.along(e), o = this.kernel.drives(e), [s, c] = [Math.ceil(a), Math.floor(a)].map((e, n) => this.march(new be(t, o), e, n ? -1 : 1, null));
		r && !this.phases.length && (s && this.poses[n[i - 1]] && this.march(s, 0, 1, r), c && this.poses[n[0]] && this.march(c, i - 1, -1, r));
	}
	along(e) {
		let { course: t } = this.data;
		if (Number.isInteger(e) && e < this.count) return t.indexOf(e);
		let n = t.every((e, t) => e === t), r = this.kernel.drives(e)[0];
		return (n ? Math.ceil(e) : t.findIndex((e) => this.kernel.drives(e)[0] > r)) - .5;
	}
	march(e, t, n, r) {
		let { course: i } = this.data, a = this.count, o = this.data.dimension === 2 ? Math.ceil(a / Ce) : 1, s = (r ?? []).map((e) => n * (r.length > 1 ? e : Math.abs(e))), c = this.counts((e) => s[this.data.drives.indexOf(e)] ?? 0), l = (e) => this.kernel.drives(i[e]).map((e, t) => e + (s[t] ?? 0)), u = (e, t) => {
			r ? this.poses[i[e]] = {
				...t,
				turn: t.turn.map((e, t) => e - c[t])
			} : this.poses[i[e]] = t;
		};
		for (let s = t; s >= 0 && s < a;) {
			if (r && this.poses[i[s]]) return null;
			let t = e.pose, c = e.drives, d = Math.min(Math.max(s + n * (o - 1), 0), a - 1);
			if (d !== s && !this.sketch.walk(e, l(d)) && (e = new be(t, c), d = s), d === s && !this.sketch.walk(e, l(s))) return null;
			for (let r = s; r !== d; r += n) u(r, Oe(t, e.pose, c, e.drives, l(r)));
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
		a && (this.poses[i] || this.follow(i, a), this.base = {
			place: i,
			pose: this.exact(i) ?? a
		}, this.spread(this.read(a, i)), r = this.kernel.closes(), this.behind(r)), this.spread(this.model), this.kernel.closes();
	}
	exact(e) {
		return this.sketch.values = this.values, this.poses[e] && this.sketch.close(this.poses[e], this.kernel.drives(e), .05);
	}
	firstOf(e) {
		let t = (t) => this.poses[t] !== null || e[t] > 0;
		return this.data.places.find(t) ?? e.findIndex((e, n) => t(n));
	}
	enter(e, t) {
		let n = this.data.dimension, r = J(t), i = .1;
		return this.kernel.posed(e).forEach((e, t) => {
			if (!e.every(Number.isFinite)) i = Infinity;
			else {
				for (let i = 0; i < n; i++) r.point[n * t + i] = e[i];
				if (n === 2) r.turn[t] += De(Math.atan2(e[3], e[2]) - r.turn[t]), [r.rotation[2 * t], r.rotation[2 * t + 1]] = [e[2], e[3]];
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
		for (let e = 1; e < Se; e++) if (!this.kernel.closesAt(t + e / Se * (n - t))) return !0;
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
		this.model = e, t.values.set(this.values), this.channels.forEach((e, a) => {
			for (let o = 0; o < r; o++) t.path[a * n + o] = e.kind === "pose" ? (this.poses[o] ?? i)[e.part][e.k] : e.kind === "position" ? this.kernel.drives(o)[e.k] : e.kind === "given" ? e.given[o] : 1;
		}), this.branches.forEach((i, a) => {
			t.call(r);
			for (let n = 0; n < r; n++) i[n] = this.poses[n] ? t.at(a, n) < 0 ? -1 : 1 : e[a];
			this.channels.forEach((e, r) => e.kind === "branch" && e.k === a && t.path.set(i, r * n)), this.inputs(this.data.branches[a]).set(i);
		}), this.data.known.length && t.call(r), this.data.known.forEach((e, n) => {
			let i = this.inputs(e);
			for (let e = 0; e < r; e++) i[e] = this.poses[e] ? t.at(this.branches.length + n, e) : NaN;
		});
	}
	at(e) {
		this.update();
		let t = Math.floor(e) % this.count, n = e - Math.floor(e) === 0 && this.count <= Ce ? this.poses[t] : null;
		this.sketch.values = this.values;
		for (let r of [t, (t + 1) % this.count]) {
			let t = this.poses[r];
			if (n || !t) continue;
			let i = this.sketch.close(t, this.kernel.drives(r), .05), a = this.nearDrives(r, e);
			n = i && this.sketch.walk(new be(i, this.kernel.drives(r)), a);
		}
		return n && ([this.held, this.loose] = [{
			values: this.values.slice(),
			t: e,
			pose: n
		}, null]), n;
	}
	nearDrives(e, t) {
		let n = this.kernel.drives(t), r = this.kernel.drives(e);
		return n.map((e, t) => this.data.cycle?.[t] ? r[t] + De(e - r[t]) : e);
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
		return e.flatMap((e, i) => t === 2 ? [r.turn[i] + (n[e] ?? 0)] : [...r.point.subarray(3 * i, 3 * i + 3), ...Me(r.rotation.subarray(9 * i, 9 * i + 9))]);
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
		let [t, ...n] = e, r = J(this.held.pose);
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
}, De = (e) => e - 2 * Math.PI * Math.round(e / (2 * Math.PI));
function Oe(e, t, n, r, i) {
	let a = r.findIndex((e, t) => e !== n[t]), o = a < 0 ? 1 : (i[a] - n[a]) / (r[a] - n[a]), s = (e, t) => e.map((e, n) => e + o * (t[n] - e)), c = s(e.turn, t.turn), l = e.rotation.slice();
	return c.forEach((e, t) => [l[2 * t], l[2 * t + 1]] = [Math.cos(e), Math.sin(e)]), {
		point: s(e.point, t.point),
		turn: c,
		rotation: l
	};
}
function ke(e) {
	let t = (t) => t.ends.filter((t) => t < e.links.length), n = new Set(e.drives.flatMap((n) => t(e.rows[n]))), r = (r) => {
		let i = t(e.rows.find((e) => e.kind === "constraint" && e.joint === r) ?? { ends: [] });
		return i.length - (i.some((e) => n.has(e)) ? .5 : 0);
	};
	return e.gaps.map((e) => e.joint).reduce((e, t) => e && r(e) >= r(t) ? e : t, "");
}
function Ae(e, t, n) {
	let r = J(t);
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
		], 3 * i), r.rotation.set(je([
			c / f,
			l / f,
			u / f
		], d), 9 * i);
	}), r;
}
function je([e, t, n], r) {
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
function Me(e) {
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
function Ne(e) {
	return Uint8Array.from(atob(e), (e) => e.charCodeAt(0));
}
function Y(e) {
	if (typeof e == "string") return new Float64Array(Ne(e).buffer);
	let t = (e.to - e.from) / Math.max(e.count - 1, 1);
	return Float64Array.from({ length: e.count }, (n, r) => r === e.count - 1 ? e.to : e.from + r * t);
}
async function Pe(e) {
	let t = new Blob([Ne(e)]).stream().pipeThrough(new DecompressionStream("deflate"));
	return new Response(t).arrayBuffer();
}
var X = class e {
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
		let { instance: r } = await WebAssembly.instantiate(await Pe(t.wasm)), { memory: i, run: a } = r.exports;
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
}, Z = 1, Fe = 1e60, Ie = class {
	table;
	breaks;
	pieces;
	constructor(e) {
		this.table = e, this.breaks = Y(e.breaks), this.pieces = Y(e.pieces);
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
}, Le = class e {
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
		this.data = e, this.whole = t, this.one = n, this.slope = a, this.count = e.kernel.count, this.row = e.kernel.row, this.values = t.values, this.values.set(e.numbers.map((e) => e.value)), this.rows = t.out, this.good = new Uint8Array(this.count), this.here = new Float64Array(e.kernel.outputs + 1), this.hereAfter = new Float64Array(e.kernel.outputs + 1), this.side = e.kernel.channels.indexOf("side"), this.after = this.side < 0 ? this.rows : this.rows.slice(), [this.read, this.later] = [this.rows, this.after], this.positions = new Map(e.drives.map((e) => [e.name, Y(e.position)])), this.channels = new Map(e.channels.map((e) => [e.name, {
			values: Y(e.values),
			pieces: e.table && new Ie(e.table),
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
		this.motion = new Ee(e, this, r, i, this.values, s), this.cyclic = !e.only_at_positions && e.drives.some((e) => e.turns && this.isWholeTurn(e.name));
	}
	static async create(t) {
		let n = t.numbers.length, [r, i, a, o, s] = await Promise.all([
			X.create(t.kernel, n),
			X.create(t.kernel, n),
			X.create(t.sketch.closure, n),
			X.create(t.sketch.shown, n),
			t.gradient ? X.create(t.gradient, n) : void 0
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
		this.motion.update(), this.closes(), this.side >= 0 && this.bothSides();
		let e = this.rows.length - this.row;
		for (let t = 0; t < this.count; t++) this.rows[e + t] = this.motion.poses[t] ? this.judged(this.rows[e + t], (e) => this.rows[e * this.row + t]) : Z, this.good[t] = +this.numbered(this.markAt(t));
	}
	closes() {
		for (let { name: e, channel: t } of this.followed) this.whole.path.set(this.channels.get(e).values, t * this.row);
		return this.whole.call(this.count), Uint8Array.from({ length: this.count }, (e, t) => +(this.markAt(t) !== Z));
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
		if (e === Z || !this.numbered(e) && this.data.statuses[e].status !== "undecided") return e;
		let n = this.numbered(e) || this.values.some((e) => Math.abs(e) > Fe);
		for (let e = 0; n && e < this.here.length - 1; e++) if (!Number.isFinite(t(e))) return this.marked("overflow");
		return e;
	}
	marked(e) {
		return this.data.statuses.findIndex((t) => t.status === e);
	}
	closesAt(e) {
		return this.run(e, null, this.motion.otherwise), this.one.at(this.here.length - 1) !== Z;
	}
	posed(e) {
		return this.data.sketch.poses.map((t) => t.map((t) => this.value(t, e)));
	}
	drives(e) {
		return this.data.drives.map((t) => this.position(t.name, e));
	}
	at(e) {
		let t = this.motion.at(e), { here: n } = this;
		this.run(e, t, t ? this.motion.read(t, e) : this.motion.otherwise);
		for (let e = 0; e < n.length; e++) [n[e], this.hereAfter[e]] = [this.one.at(e), this.one.at(e, 1)];
		let r = n.length - 1, i = this.side >= 0 ? this.between(n[r], this.hereAfter[r], (e) => n[e] === this.hereAfter[e]) : n[r];
		n[r] = this.judged(i, (e) => n[e]), t || (n[n.length - 1] = Z), this.open = [], t && n.every(Number.isFinite) || this.stretch(t ?? this.motion.stretched(e), e), this.finite = this.data.sketch.drawn.every((e) => Number.isFinite(n[e]));
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
}, Re = ".dalembert{--ink:#1d2733;--grey:#5b6672;--paper:#fff;--soft:#f4f6f8;--rim:#d5dbe1;--warn:#b3261e;--accent:#1c56a8;color:var(--ink);background:var(--paper);outline:none;font:15px/1.45 system-ui,DejaVu Sans,sans-serif;container-type:inline-size}.dalembert.full{height:100vh;flex-direction:column;height:100dvh;display:flex;overflow:hidden}.dalembert *{box-sizing:border-box}.dalembert [hidden]{display:none!important}.dalembert header{z-index:2;background:var(--paper);border-bottom:1px solid var(--rim);padding:.3em .8em;position:sticky;top:0}.dalembert h1{text-overflow:ellipsis;white-space:nowrap;margin:0;font-size:1.1em;overflow:hidden}.dalembert .bar{align-items:center;gap:.5em;margin-top:.15em;display:flex}.dalembert .bar input{min-width:4em;accent-color:var(--accent);flex:1}.dalembert .readout{white-space:nowrap;font-variant-numeric:tabular-nums;min-width:8em}.dalembert button{font:inherit;color:inherit;background:var(--soft);border:1px solid var(--rim);cursor:pointer;border-radius:.4em;padding:.15em .6em}.dalembert button:disabled{opacity:.4;cursor:default}.dalembert .mark{color:var(--warn);background:var(--paper);margin:0;padding:.2em .9em;font-size:.92em;position:absolute;top:calc(100% + 1px);left:0;right:calc(clamp(22rem,36cqw,42rem) + 1.6em)}.dalembert .mark:empty{display:none}.dalembert main{grid-template-columns:minmax(0,1fr) clamp(22rem,36cqw,42rem);align-items:start;gap:.8em;padding:.6em .8em;display:grid}.dalembert.full main{flex:1;align-items:stretch;min-height:0;padding-bottom:0}.dalembert .stage{flex-direction:column;min-width:0;display:flex;position:sticky;top:5em}.dalembert.full .stage{min-height:0;position:static}.dalembert .paper{aspect-ratio:10/7;min-height:14em;max-height:calc(100vh - 9em);position:relative}.dalembert.full .paper{aspect-ratio:auto;flex:1;min-height:0;max-height:none}.dalembert.full .side{min-height:0;padding:0 .6em 1em 0;overflow-y:auto}.dalembert svg{touch-action:pan-y;-webkit-user-select:none;user-select:none;width:100%;height:auto;font-family:DejaVu Sans,Helvetica Neue,Arial,sans-serif;display:block;overflow:hidden}.dalembert .paper svg{touch-action:none;height:100%;position:absolute;inset:0}.dalembert .cloud{pointer-events:none;width:100%;height:100%;position:absolute;top:0;left:0}.dalembert .switches{color:var(--grey);flex-wrap:wrap;gap:.2em 1em;padding:.3em 0;font-size:.9em;display:flex}.dalembert .switches label{cursor:pointer;align-items:center;gap:.3em;display:flex}.dalembert figure{margin:0 0 .4em}.dalembert figcaption{color:var(--grey);font-size:.85em}.dalembert .panel{border-top:1px solid var(--rim);padding:.3em 0}.dalembert summary{cursor:pointer;padding:.15em 0;font-weight:600}.dalembert select{font:inherit;color:inherit;background:var(--soft);border:1px solid var(--rim);border-radius:.4em;max-width:100%}.dalembert .equation{font-variant-numeric:tabular-nums;overflow-wrap:anywhere;margin:.15em 0;font-size:.85em}.dalembert .answers{border-collapse:collapse;font-variant-numeric:tabular-nums;width:100%;font-size:.85em}.dalembert .answers th{text-align:left;padding:.1em .6em .1em 0;font-weight:400}.dalembert .answers td{text-align:right}.dalembert .answers tr+tr>*{border-top:1px solid var(--soft)}.dalembert .polar{width:49%;display:inline-block}.dalembert fieldset{border:0;border-top:1px solid var(--soft);margin:0;padding:.2em 0;font-size:.88em}.dalembert legend{padding:0 .4em 0 0;font-weight:600}.dalembert fieldset label{grid-template-columns:minmax(0,1fr) 7.5em 4.5em;align-items:center;gap:.4em;margin:.1em 0;display:grid}.dalembert fieldset label input[type=range]{accent-color:var(--accent);grid-column:1/-1}.dalembert fieldset input[type=text]{font:inherit;color:inherit;background:var(--soft);border:1px solid var(--rim);border-radius:.3em;width:100%;padding:.05em .3em}.dalembert input.changed{border-color:var(--accent);font-weight:600}.dalembert .unit{color:var(--grey)}.dalembert .wrong{color:var(--warn);grid-column:1/-1}.dalembert .wrong:empty{display:none}.dalembert input[aria-invalid]{border-color:var(--warn)!important}.dalembert dl{grid-template-columns:auto 1fr;gap:.1em .8em;font-size:.9em;display:grid}.dalembert dd{margin:0}.dalembert .handle{fill:var(--accent);fill-opacity:.1;stroke:var(--accent);stroke-opacity:.35;stroke-width:.25px;cursor:grab;outline:none}.dalembert .handle:hover,.dalembert .handle:focus-visible{fill-opacity:.3;stroke-opacity:1;outline:none}.dalembert .handle.center{fill:#1a7f4b;stroke:#1a7f4b}.dalembert .handle.load{fill:#c1272d;stroke:#c1272d}.dalembert .handle.direction{fill:#7a2fa0;stroke:#7a2fa0}.dalembert .span *{vector-effect:non-scaling-stroke}.dalembert .cursor{stroke:var(--grey);stroke-width:.3px;fill:none}.dalembert .key{cursor:pointer}.dalembert .key.picked{text-decoration:underline}.dalembert .chart svg{cursor:crosshair}.dalembert [data-link]{cursor:pointer}.dalembert.unsolved svg:not(.chart svg)>g:not(.gaps){opacity:.3}@container (width<=500px){.dalembert .bar{gap:.3em}.dalembert .readout{min-width:0}.dalembert button{padding:.15em .45em}}@container (width<=760px){.dalembert main{padding:.4em .6em;display:block}.dalembert .stage,.dalembert.full .stage{position:static}.dalembert .paper,.dalembert.full .paper{aspect-ratio:1;width:100%;max-height:56vh}.dalembert .polar{width:100%}.dalembert .mark{right:0}.dalembert.full main{overflow-y:auto}.dalembert.full .side{padding:0;overflow:visible}}@media (prefers-color-scheme:dark){.dalembert{--ink:#e8edf2;--grey:#9aa7b4;--paper:#151b22;--soft:#222b35;--rim:#323d48;--warn:#ff7b74;--accent:#6fa8f5}}@media print{.dalembert{--ink:#000;--grey:#444;--paper:#fff;--soft:#fff;--rim:#999;--accent:#000}.dalembert header,.dalembert .stage{position:static}.dalembert.full{height:auto;display:block;overflow:visible}.dalembert .paper,.dalembert.full .paper{aspect-ratio:10/7;max-height:none}.dalembert.full .side{overflow:visible}.dalembert .mark{position:static}.dalembert .bar,.dalembert .switches,.dalembert .handles,.dalembert summary~div>button,.dalembert select{display:none}.dalembert main{display:block}.dalembert figure,.dalembert .panel{break-inside:avoid}}";
// src/panels.ts
function Q(e, t, r = !1) {
	let i = n("details", e, { class: "panel" });
	return i.open = r, n("summary", i, {}, t), n("div", i);
}
function ze(e, t, r, i, a) {
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
		let [s, l] = e.parameter ? ["Parameters", e.label] : Be(e.label), f = n("label", c(s), { title: e.about ?? e.path });
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
			let [i, o] = e.range ?? Ve(e.value), s = n("input", f, {
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
	return { update: () => o.forEach(d) };
}
function Be(e) {
	let t = e.indexOf(": ");
	return t < 0 ? ["Others", e] : [e.slice(0, t), e.slice(t + 2)];
}
function Ve(e) {
	let t = .5 * Math.abs(e) || 1;
	return [e - t, e + t];
}
function He(e, t, r) {
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
function Ue(e, t, r, a) {
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
function We(e, t) {
	n("p", e, {}, "One linear system per position gives forces and motion (D'Alembert's principle); everything shown is recomputed from the numbers beside it, in double precision.");
	let r = n("dl", e);
	for (let [e, i] of Object.entries(t.assumptions)) n("dt", r, {}, e), n("dd", r, {}, i);
	t.source && n("p", e, {}, `Source: ${t.source}`), n("p", e, {}, `Made with dalembert ${t.version}.`);
}
// src/charts.ts
var Ge = 16, Ke = 5, qe = 8, Je = 4;
function Ye(e, t) {
	let n = e / t || 1, r = 10 ** Math.floor(Math.log10(n));
	return r * ([
		1,
		2,
		5,
		10
	].find((e) => e * r >= n) ?? 10);
}
function Xe(e, t) {
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
	].find((n) => n >= e / t) ?? 360 * Ye(e / 360, t);
}
function Ze(e, t, n) {
	let r = Math.ceil(e / n - 1e-9), i = Math.floor(t / n + 1e-9) - r + 1;
	return Array.from({ length: Math.max(i, 0) }, (e, t) => (r + t) * n);
}
function Qe(a, o, l, u, d, p) {
	let m = n("figure", a, { class: "chart" }), h = o.units[u.kind];
	n("figcaption", m, {}, `${u.title}, ${h.unit}`);
	let g = o.views.charts.flatMap((e) => e.curves.map((e) => f(e.name, 3))), _ = Math.max(44, 13 + Je * u.curves.length), v = B(m, p, _, u.title), y = _ - Ke - qe, b = -_ / 2 + Ke, x = 0, S = 0, C = t("path", v, {
		class: "l-grid",
		style: "fill:none"
	}), w = t("path", v, {
		class: "l-axis",
		style: "fill:none"
	}), T = t("g", v), D = u.curves.map((e) => t("path", v, {
		class: `l-${e.role}`,
		style: "fill:none"
	})), O = t("path", v, { class: "cursor" }), k = u.curves.map((e) => t("circle", v, {
		class: `l-${e.role}-h`,
		r: .9
	})), A = Math.max(l.count - 1, 1), j = o.noise[u.kind] ?? 0, M = u.curves.map((e, n) => {
		let r = t("text", v, {
			class: `l-${e.role}-t key`,
			"font-size": 3,
			y: b + 3 + Je * n,
			tabindex: 0,
			role: "button"
		});
		return c(r, e.name, 3), t("title", r).textContent = "show what lowers its peak", r.addEventListener("click", () => d.pick(e)), r.addEventListener("keydown", (t) => t.key === "Enter" && d.pick(e)), r;
	}), N = (e, t) => {
		let n = l.value(e.row, t) / h.size;
		return Math.abs(n) * h.size < j ? 0 : n;
	}, P = NaN, F = NaN, I = 1, L = (e) => S + e / A * x, R = (e) => b + y - (e - P) / (F - P) * y;
	function z() {
		let [e, t] = [Infinity, -Infinity];
		for (let n of u.curves) for (let r = 0; r < l.count; r++) if (l.good[r]) {
			let i = N(n, r), a = l.reverses(r) ? l.onceAfter(() => N(n, r)) : i;
			e = Math.min(e, i, a), t = Math.max(t, i, a);
		}
		return e <= t || ([e, t] = [0, 1]), e > 0 && e < .4 * t && (e = 0), t < 0 && t > .4 * e && (t = 0), t - e < 1e-9 * Math.max(Math.abs(t), Math.abs(e), 1e-9) && ([e, t] = [Math.min(e, 0), Math.max(t, 0) || 1]), I = Ye(t - e, 4), [e, t] = [Math.floor(e / I + 1e-9) * I, Math.ceil(t / I - 1e-9) * I], e === P && t === F ? !1 : ([P, F] = [e, t], !0);
	}
	function V() {
		let e = o.drives[0], n = (e, n, r, i) => t("text", T, {
			class: "l-note-t",
			"font-size": 2.6,
			"text-anchor": i,
			x: n,
			y: r
		}).textContent = e;
		T.replaceChildren();
		let a = "";
		for (let e of Ze(P, F, I)) a += `M${S} ${r(R(e))}h${x}`, n(i(e, 5), S - 1.2, R(e) + .9, "end");
		if (e) {
			let [t, o] = [0, A].map((t) => l.position(e.name, t) / e.size);
			for (let s of Ze(Math.min(t, o), Math.max(t, o), (e.unit === "°" ? Xe : Ye)(Math.abs(o - t), 6))) {
				let c = S + (s - t) / (o - t || 1) * x;
				a += `M${r(c)} ${b}v${y}`, n(i(s, 5) + (e.unit === "°" ? "°" : ""), c, b + y + 3.4, "middle");
			}
			n(`${e.name}, ${e.unit}`, S + x, b + y + 6.6, "end");
		}
		C.setAttribute("d", a), w.setAttribute("d", `M${S} ${b}v${y}` + (P < 0 && F > 0 ? `M${S} ${r(R(0))}h${x}` : ""));
	}
	function H(e) {
		p = e, [x, S] = [p - Ge - Math.min(Math.max(...g) + 4, .3 * p), -p / 2 + Ge], v.setAttribute("viewBox", `${-p / 2} ${-_ / 2} ${p} ${_}`), M.forEach((e) => e.setAttribute("x", r(S + x + 2))), P = NaN;
	}
	H(p);
	let U = (e) => d.seek((s(v, e)[0] - S) / x * A);
	return v.addEventListener("pointerdown", (e) => {
		e.target.closest(".key") || (v.setPointerCapture(e.pointerId), U(e));
	}), v.addEventListener("pointermove", (e) => e.buttons && v.hasPointerCapture(e.pointerId) && U(e)), {
		resize: H,
		update(t) {
			t && (z() && V(), D.forEach((e, t) => e.setAttribute("d", E(l, (e) => [L(e), R(N(u.curves[t], e))]))));
			let n = r(L(Math.min(d.time(), A)));
			O.setAttribute("d", `M${n} ${b}v${y}`), u.curves.forEach((t, i) => {
				let a = l.solved ? {
					cx: n,
					cy: r(R(l.here[t.row] / h.size))
				} : {};
				e(k[i], {
					visibility: l.solved ? "visible" : "hidden",
					...a
				}), M[i].classList.toggle("picked", d.picked() === t);
			});
		}
	};
}
function $e(e, r, a, o) {
	let s = n("figure", e, { class: "polar" }), [c, l] = a.f, u = n("figcaption", s), d = B(s, 66, 66, `polar diagram of joint ${a.name}`);
	t("path", d, {
		class: "l-grid",
		style: "fill:none",
		d: "M-30 0H30M0 -30V30M15 0A15 15 0 1 0 -15 0A15 15 0 1 0 15 0M30 0A30 30 0 1 0 -30 0A30 30 0 1 0 30 0"
	});
	let f = t("path", d, {
		class: `l-${a.role}`,
		style: "fill:none"
	}), p = new m(d, "joint-force", a.name), h = 1;
	return { update(e) {
		if (e) {
			let e = N(r.largest((e) => Math.hypot(r.value(c, e), r.value(l, e))) / o.size);
			h = e / 30 * o.size, f.setAttribute("d", E(r, (e) => [r.value(c, e) / h, -r.value(l, e) / h], !0)), u.textContent = `Joint ${a.name}: circles of ${i(e / 2)} and ${i(e)} ${o.unit}`;
		}
		p.set([0, 0], r.solved ? [r.here[c] / h, -r.here[l] / h] : [0, 0]);
	} };
}
function et(e, r, i, o, s) {
	let c = n("figure", e, { class: "polygon" }), l = r.units.force;
	n("figcaption", c, {}, o);
	let u = B(c, 110, 80, o), d = t("g", u), f = /* @__PURE__ */ new Set(), p = s.map(({ sides: e }) => {
		let t = e.find((e) => e.kind === "joint" && f.has(e.of));
		for (let t of e) t.kind === "joint" && f.add(t.of);
		return {
			shared: t,
			drawn: e.filter((e) => e !== t).map((e) => ({
				s: e,
				arrow: new m(u, e.role, e.name),
				name: v(d, e.role, e.name, 3)
			}))
		};
	}), h = t("path", u, {
		class: "l-gap",
		style: "fill:none"
	}), g = new z(u, !0);
	return {
		figure: c,
		update() {
			if (u.setAttribute("visibility", i.solved ? "visible" : "hidden"), !i.solved) return;
			let e = i.here, t = /* @__PURE__ */ new Map(), n = [], r = [], o = p.flatMap(({ shared: i, drawn: a }) => {
				let o = F(n)?.y[1] ?? 0, s = t.get(i?.of ?? "") ?? [0, o], c = (t) => [s[0] + e[t[0]], s[1] - e[t[1]]], l = s;
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
			}), s = F(n) ?? {
				x: [0, 0],
				y: [0, 0]
			}, c = N(Math.max((s.x[1] - s.x[0]) / 66, (s.y[1] - s.y[0]) / 48) / l.size) * l.size, d = ([e, t]) => [(e - (s.x[0] + s.x[1]) / 2) / c, (t - (s.y[0] + s.y[1]) / 2) / c], f = new y([
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
var tt = 4.6, nt = (e) => Math.min(Math.max(e / tt, 72), 140), rt = (e) => e.closest("details")?.open ?? !0;
function it(e, t, r, i, a) {
	let { charts: o, bodies: s, polygons: c } = t.views, l = [], u = [];
	if (r.count > 1) for (let n of o) l.push(Qe(e, t, r, n, i, 120));
	let d = Q(e, "Free body", !0), f = n("select", d, { "aria-label": "link" }), p = s.map((e, i) => {
		n("option", f, { value: i }, `${e.title}${e.member && `, ${e.member} member`}`);
		let a = n("div", d, { class: "body" }), o = V(a, r, e, e.about, 110, 100, t.units, `free body of ${e.title}`);
		return u.push({
			box: a,
			view: o,
			link: i
		}, {
			box: a,
			view: Ue(a, t, r, e),
			link: i
		}), o;
	});
	if (c.links.length) {
		let n = Q(e, "Force polygon"), i = Q(e, "Force polygons of the chain");
		c.links.forEach((e, i) => {
			let a = et(n, t, r, `Force polygon of link ${e.title}`, [e]);
			u.push({
				box: a.figure,
				view: a,
				link: i
			});
		});
		let a = c.chain.map((e) => c.links[e]);
		u.push({
			box: i,
			view: et(i, t, r, `In the order of solution: ${a.map((e) => e.title).join(" → ")}`, a)
		});
	}
	let m = r.count > 2 ? o.flatMap((e) => e.curves).filter((e) => e.f) : [];
	if (m.length) {
		let n = Q(e, "Polar diagrams");
		for (let e of m) u.push({
			box: n,
			view: $e(n, r, e, t.units.force)
		});
	}
	let h = Q(e, "Numbers of this position");
	u.push({
		box: h,
		view: He(h, t, r)
	}), f.addEventListener("change", a);
	function g() {
		for (let e of p) e.fit();
		let e = Math.max(0, ...p.map((e) => e.need()));
		for (let t of p) t.fit(e || void 0);
	}
	return {
		bodies: p,
		fit: g,
		resize: (e) => l.forEach((t) => t.resize(nt(e))),
		choose(e) {
			let t = s.findIndex((t) => t.link === e);
			t >= 0 && (f.value = String(t)), a();
		},
		update(e) {
			for (let t of l) t.update(e);
			for (let { box: t, view: n, link: r } of u) r !== void 0 && (t.hidden = r !== +f.value), (r === void 0 || r === +f.value) && rt(t) && n.update(e);
		}
	};
}
// src/sentences.ts
function $(e, t = 6) {
	if (!Number.isFinite(e)) return Number.isNaN(e) ? "nan" : e > 0 ? "inf" : "-inf";
	let [n, r] = e.toExponential(t - 1).split("e"), i = +r, a = (e) => e.includes(".") ? e.replace(/\.?0+$/, "") : e;
	return i < -4 || i >= t ? `${a(n)}e${i < 0 ? "-" : "+"}${String(Math.abs(i)).padStart(2, "0")}` : a(e.toFixed(Math.max(t - 1 - i, 0)));
}
var at = (e) => e.length < 2 ? e.join("") : `${e.slice(0, -1).join(", ")} and ${e.at(-1)}`, ot = class {
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
			if (Math.abs(r - o) > n * o) return W(e, {
				found: $(r),
				ri: $(Math.abs(i)),
				rj: $(Math.abs(a)),
				wanted: $(o)
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
			text: r === "not_assembled" ? this.open(a, o) : W(a, this.places(r, o, e))
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
		let { kernel: a, s: o } = this, s = o.unknowns.map((e) => e.name), c = o.contacts.filter((t) => e === "reversal" ? a.here[t.row] !== a.hereAfter[t.row] : a.here[t.row] === 0), l = [...new Set(c.map((e) => e.joint))], u = o.unknowns.map((e) => W(o.words.sides, {
			name: e.name,
			before: this.quantity(a.here[e.row], e.kind),
			after: this.quantity(a.hereAfter[e.row], e.kind)
		})), d = e === "reversal" ? l.length === 1 ? "reverses" : "reverse" : s.length === 1 ? "lies in an interval" : "each lie in an interval";
		return {
			...i,
			joints: e === "reversal" ? at(l) : l.join(", "),
			verb: d,
			values: at(u),
			name: s[0] ?? "",
			names: at(s)
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
			e > c && ([c, l] = [e, t], u = r.unknowns.map(({ name: e, kind: t, row: i }) => W(r.words.needs, {
				name: e,
				rubbed: this.quantity(n.here[i], t),
				bare: this.quantity(o[i], t)
			})).join(", "));
		}
		return n.at(t), `;${e[0] === e[1] ? "" : this.arc([l, l])} ${u}`;
	}
	quantity(e, t, n = 6) {
		let { unit: r, size: i } = this.s.units[t];
		return `${$(e / i, n)} ${r}`;
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
		return l.length ? W(e, {
			span: s,
			gap: `: ${t !== n && this.data.drives.length ? `${this.arc([r, r]).trim()} ` : ""}${l.join(" and ")}`,
			datum: c ? "a length" : "a direction"
		}) : this.loose(i) || W(this.s.words.unfollowed, { span: s });
	}
	loose(e) {
		let { drives: t, sketch: n } = this.data, r = this.kernel.motion.sketch.mobility(e), i = r.freedoms - t.length;
		if (n.dimension !== 2 || i <= 0) return "";
		let a = r.joints.slice(0, 6).map((e) => `${e.joint} (${e.angular ? "turn" : "slide"})`), o = a.length ? ` at ${i === 1 ? "one" : "some"} of ${a.join(", ")}` : "", s = (e, t) => e ? `${e} ${t}${e > 1 ? "s" : ""}` : `no ${t}`;
		return `${W(this.s.words.counts, {
			freedoms: s(r.freedoms, "freedom"),
			drives: s(t.length, "drive")
		})}; ${W(this.s.words.add, {
			drives: s(i, "drive"),
			where: o,
			loose: r.links.join(", ")
		})}`;
	}
	most(e, t, n) {
		let { words: r, limits: i } = this.s, a = e.filter(([, e]) => e > i.shut * n);
		if (!a.length) return "";
		let [o, s] = a.reduce((e, t) => t[1] > e[1] ? t : e), c = this.quantity(s, t, 3);
		if (a.length === 1) return W(r.one, {
			...r.kinds[t],
			joint: o,
			figure: c
		});
		let l = Math.min(...a.map(([, e]) => e)) > i.alike * s ? W(r.alike, { joints: a.map(([e]) => e).join(", ") }) : W(r.most, {
			joint: o,
			figure: c
		});
		return W(r.several, {
			...r.kinds[t],
			total: this.quantity(e.reduce((e, [, t]) => e + t, 0), t, 3),
			where: l
		});
	}
	whose() {
		let { overflow: e, words: t } = this.s, n = (e) => this.kernel.here[e], r = "";
		for (let [i, a] of Object.entries(e)) {
			let o = a.filter(([, ...t]) => !t.every((t) => Number.isFinite(n(t) * n(t)) || Number.isFinite(n(t)) && i !== Object.keys(e)[0])).map(([e]) => e);
			if (o.length) return W(t.of, {
				what: i,
				names: o.join(", ")
			});
			r = W(t.checks, { what: i });
		}
		return r;
	}
}, st = class {
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
			where: t.count > 1 ? ` at ${ct(this.data, t, i)}` : ""
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
}, ct = (e, t, n) => e.drives.map((e) => `${e.name} = ${i(t.position(e.name, n) / e.size, 5)}${e.unit === "°" ? "" : " "}${e.unit}`).join(", "), lt = class {
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
}, ut = class {
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
function dt(e, t) {
	let n = e.numbers.flatMap((e, n) => t.values[n] === e.value ? [] : [[e.path, t.values[n]]]), r = n.length ? t.motion.assembly() : [];
	return Object.fromEntries([...n, ...r.map((t, n) => [e.sketch.assembly[n], t])]);
}
function ft(e, t, n) {
	let r = new URLSearchParams({ t: String(+n.toFixed(4)) });
	for (let [n, i] of Object.entries(dt(e, t))) r.set(n, String(i));
	return r.toString();
}
function pt(e, t, n) {
	let r = new Map([...new URLSearchParams(n.replace(/^#/, ""))].map(([e, t]) => [e, t.trim() ? Number(t) : NaN])), i = r.get("t") ?? 0;
	return r.delete("t"), t.change(Object.fromEntries(r)), Number.isFinite(i) ? Math.min(Math.max(i, 0), e.end) : 0;
}
function mt(e, t) {
	let n = [...t.values, ...t.motion.assembly()], r = e.numbers.map((e, n) => e.value !== t.values[n]), i = r.includes(!0);
	return e.template.map((e) => typeof e == "string" ? e : e.was !== void 0 && !e.of?.some((e) => r[e] ?? i) ? e.was : e.now.map((e) => typeof e == "string" ? e : String(n[e[0]] / e[1])).join("")).join("");
}
function ht(e, t) {
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
function gt(n, r) {
	let i = n.cloneNode(!0), { width: a, height: o } = n.viewBox.baseVal;
	i.querySelectorAll(".handles").forEach((e) => e.remove()), e(i, {
		xmlns: "http://www.w3.org/2000/svg",
		width: `${a}mm`,
		height: `${o}mm`,
		"font-family": "'DejaVu Sans', Arial, sans-serif"
	});
	let s = t("style", null);
	return s.textContent = r, i.prepend(s), new XMLSerializer().serializeToString(i);
}
function _t(e, t, n) {
	let r = document.createElement("a");
	r.href = URL.createObjectURL(new Blob([t], { type: n })), r.download = e, r.click(), setTimeout(() => URL.revokeObjectURL(r.href), 1e3);
}
var vt = (e) => l(e).toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "").slice(0, 60) || "mechanism";
// src/toolbar.ts
function yt(e, t, r, i, a) {
	let o = n("header", e);
	n("h1", o, {}, t.title);
	let s = n("div", o, {
		class: "bar",
		role: "toolbar",
		"aria-label": "cycle and page"
	}), c = (e, t, r) => {
		let i = n("button", s, {
			type: "button",
			title: t,
			.../^\w/.test(e) ? {} : { "aria-label": t }
		}, e);
		return i.addEventListener("click", r), i;
	}, l = c("▶", "play along the cycle (space)", a.play), u = n("input", s, {
		type: "range",
		min: 0,
		max: r.end,
		step: t.only_at_positions ? 1 : "any",
		"aria-label": "position in the cycle"
	}), d = n("output", s, { class: "readout" }), f = c("↶", "undo (Ctrl+Z)", () => a.go(!0)), p = c("↷", "redo (Ctrl+Y)", () => a.go(!1));
	c("Reset", "all numbers as in the file", a.reset);
	let m = n("p", o, {
		class: "mark",
		role: "status"
	});
	u.addEventListener("input", () => a.show(+u.value));
	for (let e of [
		l,
		u,
		d
	]) e.hidden = r.count < 2;
	return {
		playing: (e) => l.textContent = e ? "❚❚" : "▶",
		update(e, n, a) {
			let o = [a, i.at(e)].filter(Boolean).join(" ");
			m.textContent !== o && (m.textContent = o), u.value = String(e), d.textContent = ct(t, r, e), [f.disabled, p.disabled] = n.map((e) => !e);
		}
	};
}
// src/page.ts
var bt = 3.6, xt = 5.2, St = "input:not([type=range],[type=checkbox]),textarea,[contenteditable]", Ct = "button,summary,select,a,input[type=checkbox],[role=button]", wt = 6;
async function Tt(e, t, r = {}) {
	if (t.format !== "dalembert-page/1") throw Error(`this page cannot show data of format ${t.format}`);
	let a = await Le.create(t), o = document.createElement("div"), s = [];
	o.className = r.full ? "dalembert full" : "dalembert", o.tabIndex = -1;
	let c = `@media (prefers-color-scheme:dark){${t.style.dark}}@media print{${t.style.light}}`;
	n("style", o).textContent = Re + t.style.light + c;
	let u = new re(t, a);
	r.changes && u.change(r.changes);
	let d = r.address ? pt(a, u, location.hash) : 0, f = 0, p = !0, m = 0;
	a.cycle();
	let h = new ut(a, u), g = t.views.charts.flatMap((e) => e.curves.map((n) => ({
		curve: n,
		unit: t.units[e.kind]
	}))), _ = g.find((e) => t.gradient?.curves.includes(e.curve.row)), v = new ot(t, a), y = yt(o, t, a, v, {
		play: W,
		show: U,
		go: R,
		reset: L
	}), b = n("main", o), x = n("section", b, {
		class: "stage",
		"aria-label": "mechanism"
	}), S = n("div", x, { class: "paper" }), C = V(S, a, t.views.mechanism, null, 170, 119, t.units, "the mechanism"), w = new st(C, t, a), T = new lt(S, C, t, a, t.handles.flatMap((e) => e.kind === "joint" || e.kind === "point" ? [e.p] : [])), E = ie(C, t, a, {
		changed: F,
		finished: I,
		seek: U,
		time: () => d
	}), D = H(C, t, a), O = n("section", b, {
		class: "side",
		"aria-label": "results"
	}), k = it(O, t, a, {
		time: () => d,
		seek: U,
		pick: (e) => (_ = g.find((t) => t.curve === e), K(!0)),
		picked: () => _?.curve
	}, () => K(!0)), A = M(), j = ze(Q(O, "Change numbers", t.numbers.some((e) => e.parameter)), t, a, u, (e) => e ? I() : F());
	We(Q(O, "Method and assumptions"), t), N(), C.svg.addEventListener("click", (e) => k.choose(e.target.closest("[data-link]")?.dataset.link));
	function M() {
		let e = n("div", x, { class: "switches" }), r = (t, r, i, a) => {
			let o = n("label", e, { title: r }), s = n("input", o, { type: "checkbox" });
			s.checked = i, o.append(t), s.addEventListener("change", () => (a(s.checked), K(!0)));
		};
		return r("names", "names of joints", C.names, (e) => C.names = e), t.gradient && r("what lowers the peak", "arrows: moving a joint in this direction lowers the peak of the chosen curve", !1, (e) => w.on = e), t.handles.some((e) => e.kind === "joint") && r("tolerances", "a thousand machines with points displaced by up to 0.5 % of the drawing's width", !1, (e) => T.on = e), C.paper.axes.length > 2 && (n("span", e, {}, "drag to rotate the view"), Et([C, ...k.bodies], () => (z(), K(!0)))), n("span", e, { class: "spread" });
	}
	function N() {
		let e = Q(O, "Save and share"), i = vt(t.title), o = (t, r) => n("button", e, { type: "button" }, t).addEventListener("click", r);
		o("Model file", () => _t(`${i}.yaml`, mt(t, a), "text/yaml")), o("Curves as CSV", () => _t(`${i}.csv`, ht(t, a), "text/csv")), o("Drawing as SVG", () => _t(`${i}.svg`, gt(C.svg, t.style.light), "image/svg+xml")), o("Print", () => window.print()), r.address && o("Copy link", () => {
			location.hash = ft(t, a, d), navigator.clipboard?.writeText(location.href);
		});
	}
	function P() {
		K(!0), j.update(), r.edited?.(dt(t, a)), r.address && window.history.replaceState(null, "", "#" + ft(t, a, d));
	}
	function F() {
		u.pass(), K(!0);
	}
	function I() {
		let { sentence: e } = u;
		u.pass() && (u.sentence = e), h.note(), z(), P();
	}
	function L() {
		u.change({}), I();
	}
	function R(e) {
		h.go(e) && (z(), P());
	}
	function z() {
		a.cycle(), C.fit(), k.fit();
	}
	function B() {
		let { width: e, height: t } = S.getBoundingClientRect();
		if (e > 0 && t > 0) {
			let n = Math.min(Math.max(Math.min(e / 170, t / 105), bt), xt);
			C.resize(e / n, t / n);
		}
		O.clientWidth > 0 && k.resize(O.clientWidth), C.fit(), K(!0);
	}
	function U(e) {
		d = Math.min(Math.max(e, 0), a.end), t.only_at_positions && (d = Math.round(d)), K(!1);
	}
	function W() {
		if (y.playing(!m), m) return G();
		let e = performance.now(), t = d, n = (r) => {
			t += (r - e) / 1e3 / wt * a.end, e = r, t >= a.end && (t = 0), U(t), m = requestAnimationFrame(n);
		};
		m = requestAnimationFrame(n);
	}
	function G() {
		cancelAnimationFrame(m), m = 0;
	}
	function K(e) {
		p ||= e, f ||= requestAnimationFrame(() => {
			f = 0;
			let e = performance.now();
			ee(), s.push(performance.now() - e), s.length > 2e3 && s.shift();
		});
	}
	function ee() {
		let e = p;
		p = !1, e && a.cycle(), a.at(d);
		let t = v.refusal();
		t !== a.refused && (a.refused = t, a.cycle()), o.classList.toggle("unsolved", !a.solved), C.update(e), E(), D(), w.update(_?.curve);
		let n = T.update(_?.curve.row), r = w.on && _ && w.peak(_.curve), s = r && _ ? `arrows lower the peak of ${l(_.curve.name)}, now ${i(r.size / _.unit.size)} ${_.unit.unit}${r.where}` : "";
		A.textContent = [s, n && _ ? `${l(_.curve.name)}: ${i(n.mean / _.unit.size)} ± ${i(n.sigma / _.unit.size, 2)} ${_.unit.unit} (1 σ)` : ""].filter(Boolean).join("; "), k.update(e), y.update(d, h.can, u.sentence);
	}
	o.querySelectorAll("details").forEach((e) => e.addEventListener("toggle", () => K(!0)));
	let te = r.full ? document : o, ne = (e) => q(e);
	te.addEventListener("keydown", ne);
	function q(e) {
		let t = e.target;
		e.defaultPrevented || t.closest?.(St) || ((e.ctrlKey || e.metaKey) && !e.altKey && /^[zy]$/i.test(e.key) ? (e.preventDefault(), R(e.key.toLowerCase() === "z" && !e.shiftKey)) : e.key === " " && !e.ctrlKey && !e.metaKey && !t.closest?.(Ct) && a.count > 1 && (e.preventDefault(), W()));
	}
	a.at(d), e.replaceChildren(o), z(), B(), ee(), j.update();
	let ae = new ResizeObserver(B);
	for (let e of [S, O]) ae.observe(e);
	return {
		kernel: a,
		data: t,
		times: s,
		show: U,
		set(e) {
			u.change(e), h.note(), z(), K(!0), j.update();
		},
		text: () => mt(t, a),
		remove() {
			G(), ae.disconnect(), te.removeEventListener("keydown", ne), o.remove();
		}
	};
}
function Et(e, t) {
	for (let n of e) n.svg.style.cursor = "move", n.svg.addEventListener("pointerdown", (e) => n.svg.setPointerCapture(e.pointerId)), n.svg.addEventListener("pointermove", (r) => {
		if (n.svg.hasPointerCapture(r.pointerId)) {
			for (let t of e) t.paper.turn(-.01 * r.movementX, .01 * r.movementY);
			t();
		}
	});
}
// src/main.ts
async function Dt(e, t) {
	try {
		return await Tt(e, JSON.parse(new TextDecoder().decode(await Pe(t))), {
			address: location.protocol !== "about:",
			full: !0
		});
	} catch (t) {
		throw e.textContent = String(t), t;
	}
}
var Ot = { async render({ model: e, el: t }) {
	let r = "", i = (t) => {
		r = JSON.stringify(t), e.set("changes", t), e.save_changes();
	}, a = async () => {
		let r = await Tt(t, e.get("data"), {
			edited: i,
			changes: e.get("changes")
		});
		return n("style", t, {}, `[data-dalembert="${e.get("frame")}"]{display:none}`), r;
	}, o = await a(), s = async () => {
		o.remove(), o = await a();
	}, c = () => JSON.stringify(e.get("changes")) !== r && o.set(e.get("changes"));
	return e.on("change:data", s), e.on("change:changes", c), () => {
		e.off("change:data", s), e.off("change:changes", c), o.remove();
	};
} };
export { Ot as default, Dt as open };
