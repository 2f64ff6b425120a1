#include "tests/trainees/desk/browser/page_faults.h"

namespace trocar::test {
namespace {

// Contrast: (L1 + 0.05) / (L2 + 0.05) of relative luminances, WCAG 2.1, 1.4.3.
constexpr const char* kFaults = R"js(
const faults = [], root = document.scrollingElement;
const name = e => e.tagName.toLowerCase() + (e.id ? '#' + e.id : '') + ' "' + (e.textContent || '').trim().slice(0, 30) + '"';
const seen = e => e.checkVisibility({opacityProperty: true, visibilityProperty: true, contentVisibilityAuto: true});
if (root.scrollWidth > window.innerWidth) {
  const wide = [...document.querySelectorAll('body *')].filter(
    e => e.getBoundingClientRect().right > window.innerWidth + 1 && !e.closest('.scroll, .plot, .code, .skip, svg'));
  faults.push('scrolls sideways: ' + root.scrollWidth + ' > ' + window.innerWidth + ' ' + wide.slice(0, 3).map(name).join(', '));
}
for (const e of document.querySelectorAll('input:not([type=hidden]), select, textarea'))
  if (!(e.labels && e.labels.length && e.labels[0].textContent.trim()) && !e.getAttribute('aria-label'))
    faults.push('no label: ' + name(e));
for (const e of document.querySelectorAll('button, a[href], summary'))
  if (!e.textContent.trim() && !e.getAttribute('aria-label')) faults.push('no words: ' + e.outerHTML.slice(0, 80));
for (const e of document.querySelectorAll('button, .button, select, .badge'))
  if (seen(e) && e.scrollWidth > e.clientWidth + 1) faults.push('cut off: ' + name(e));
for (const e of document.querySelectorAll('button, .button, select, input:not([type=hidden])')) {
  const box = e.getBoundingClientRect();
  if (seen(e) && (box.height < 23.5 || box.width < 23.5) && e.type !== 'range')
    faults.push('small: ' + name(e) + ' ' + box.width + ' x ' + box.height);
}
const rgba = text => { const m = text.match(/[\d.]+/g); return m ? [+m[0], +m[1], +m[2], m.length > 3 ? +m[3] : 1] : null; };
const over = (top, under) => [0, 1, 2].map(i => top[i] * top[3] + under[i] * (1 - top[3])).concat(1);
const part = v => (v /= 255) <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
const light = c => 0.2126 * part(c[0]) + 0.7152 * part(c[1]) + 0.0722 * part(c[2]);
const ground = e => {
  const layers = [];
  for (; e && !(layers.length && layers.at(-1)[3] === 1); e = e.parentElement) {
    const c = rgba(getComputedStyle(e).backgroundColor);
    if (c && c[3] > 0) layers.push(c);
  }
  let out = [255, 255, 255, 1]; while (layers.length) out = over(layers.pop(), out);
  return out;
};
const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT), done = new Set();
for (let n = walker.nextNode(); n; n = walker.nextNode()) {
  const e = n.parentElement;
  if (!n.textContent.trim() || done.has(e) || e.closest('.unseen, .skip, script, style, option') || !seen(e)) continue;
  done.add(e);
  const style = getComputedStyle(e), inDrawing = e.namespaceURI.endsWith('svg');
  const colour = rgba(inDrawing ? style.fill : style.color);
  if (!colour) continue;
  const under = ground(inDrawing ? e.closest('svg').parentElement : e), mine = over(colour, under);
  const [a, b] = [light(mine), light(under)], ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
  const size = parseFloat(style.fontSize), large = size >= 24 || (size >= 18.66 && +style.fontWeight >= 700);
  if (ratio < (large ? 3 : 4.5)) faults.push('contrast ' + ratio.toFixed(2) + ': ' + name(e));
}
return faults;
)js";

constexpr const char* kPaper = R"js(
const faults = [], width = document.documentElement.clientWidth, shown = e => e.checkVisibility();
for (const e of document.querySelectorAll('form, button, .button, input, nav, .skip, summary, .files'))
  if (shown(e)) faults.push('printed: ' + e.outerHTML.slice(0, 60));
for (const e of document.querySelectorAll('main a'))
  if (shown(e) && getComputedStyle(e).textDecorationLine !== 'none') faults.push('underlined: ' + e.textContent);
for (const e of document.querySelectorAll('main *'))
  if (shown(e) && e.getBoundingClientRect().right > width + 1 && !e.closest('svg svg, svg *, .unseen'))
    faults.push('cut: ' + e.outerHTML.slice(0, 60));
for (const e of document.querySelectorAll('.scroll, .plot'))
  if (e.scrollWidth > e.clientWidth + 1) faults.push('wider than its place: ' + e.textContent.trim().slice(0, 40));
const line = document.querySelector('.paper');
if (!line || !shown(line) || !/\d{4}, \d\d:\d\d UTC/.test(line.textContent)) faults.push('no line of whose page it is');
return faults.slice(0, 8);
)js";

constexpr const char* kNoteFocus = R"js(
window.focused = []; window.faint = [];
document.activeElement.blur();
window.scrollTo(0, 0);
document.addEventListener('focusin', event => {
  const e = event.target, style = getComputedStyle(e), box = e.getBoundingClientRect();
  if (window.focused.includes(e)) return;  // round again: the focus has been with the browser's own bars meanwhile
  window.focused.push(e);
  if (style.outlineStyle === 'none' || parseFloat(style.outlineWidth) < 2)
    window.faint.push('no outline: ' + e.outerHTML.slice(0, 90));
  if (box.bottom < 0 || box.top > window.innerHeight) window.faint.push('off the screen: ' + e.outerHTML.slice(0, 90));
});
window.reachable = [...document.querySelectorAll('a[href], button, input:not([type=hidden]), select, textarea, summary, [tabindex="0"]')]
  .filter(e => !e.disabled && e.getAttribute('tabindex') !== '-1' &&
          e.checkVisibility({visibilityProperty: true, contentVisibilityAuto: true}));
return window.reachable.length;
)js";

constexpr const char* kJudgeFocus = R"js(
const out = [...new Set(window.faint)], seen = window.focused.filter(e => window.reachable.includes(e));
window.reachable.forEach((e, i) => { if (seen[i] !== e)
  out.push('stop ' + (i + 1) + ' is ' + (seen[i] ? seen[i].outerHTML.slice(0, 70) : 'nothing') + ', not ' + e.outerHTML.slice(0, 70)); });
return out.slice(0, 8);
)js";

}  // namespace

std::vector<std::string> faults_of_page(Browser& browser) {
  return browser.run(kFaults).get<std::vector<std::string>>();
}

std::vector<std::string> faults_of_paper(Browser& browser) {
  return browser.run(kPaper).get<std::vector<std::string>>();
}

std::vector<std::string> faults_of_tab_order(Browser& browser) {
  browser.keep_focused();
  const int stops = browser.run(kNoteFocus).get<int>();
  constexpr int kScrollers = 12;  // Chromium lets what scrolls by itself have the focus too
  browser.press(key::kTab, stops + kScrollers);
  return browser.run(kJudgeFocus).get<std::vector<std::string>>();
}

}  // namespace trocar::test
