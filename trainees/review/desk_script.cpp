// The desk's only script: the attempt page follows the slider without loading the page anew. Everything works without it.
#include "trainees/review/pages.h"

namespace trocar::review {

namespace {
constexpr char kScript[] = R"js('use strict';
(function () {
  var form = document.getElementById('scrub');
  var slider = document.getElementById('t');
  if (!form || !slider) return;
  var picture = document.getElementById('picture');
  var cursor = document.getElementById('cursor');
  var now = document.getElementById('now');
  var plot = document.querySelector('svg.time');
  var forces = (form.getAttribute('data-force') || '').split(',');
  var end = parseFloat(plot.getAttribute('data-end')), left = parseFloat(plot.getAttribute('data-left')), right = parseFloat(plot.getAttribute('data-right'));
  var heading = document.getElementById('moment-h');
  var wanted = null, loading = false;
  form.querySelector('button').hidden = true;

  function load() {
    if (!picture || loading || wanted === null) return;
    loading = true;
    var t = wanted;
    wanted = null;
    picture.src = picture.getAttribute('data-base') + t.toFixed(2);
    picture.alt = 'View of the scope at ' + t.toFixed(1) + ' s';
  }
  // The first picture of an attempt takes some seconds: the run is replayed before. Asked again until it is there.
  var tries = 0;
  function loaded() { loading = false; tries = 0; load(); }
  function failed() {
    loading = false;
    if (wanted === null && tries < 40) { tries += 1; setTimeout(function () { if (wanted === null) wanted = parseFloat(slider.value); load(); }, 1500); }
    else load();
  }
  if (picture) {
    picture.addEventListener('load', loaded);
    picture.addEventListener('error', failed);
    if (picture.complete && picture.naturalWidth === 0) failed();
  }
  function show(t) {
    t = Math.min(Math.max(t, 0), end);
    if (cursor) cursor.setAttribute('transform', 'translate(' + (left + (right - left) * t / end).toFixed(1) + ' 0)');
    var slot = Math.min(forces.length - 1, Math.floor(t / end * forces.length));
    now.textContent = t.toFixed(1) + ' s: up to ' + forces[slot] + ' N at the tip';
    if (heading) heading.textContent = 'Force and picture at ' + t.toFixed(1) + ' s';
    wanted = t;
    load();
  }
  function neighbour(next, otherwise) {
    var here = parseFloat(slider.value), best = otherwise, found = false;
    document.querySelectorAll('#events td a').forEach(function (link) {
      var t = parseFloat(/t=([0-9.]+)/.exec(link.getAttribute('href'))[1]);
      if (next ? t > here + 0.05 && (!found || t < best) : t < here - 0.05 && (!found || t > best)) { best = t; found = true; }
    });
    return found ? best : here;
  }
  function keep() { history.replaceState(null, '', form.getAttribute('action').split('#')[0] + '?t=' + parseFloat(slider.value).toFixed(2)); }
  slider.addEventListener('input', function () { show(parseFloat(slider.value)); });
  slider.addEventListener('change', keep);
  document.addEventListener('click', function (event) {
    var link = event.target.closest ? event.target.closest('#moment a, #events a') : null;
    if (!link || event.ctrlKey || event.metaKey || event.shiftKey || event.button !== 0) return;
    var found = /[?&]t=([0-9.]+)/.exec(link.getAttribute('href') || '');
    if (!found) return;
    var step = /^[+\u2212](\d+) s$/.exec(link.textContent);
    var t = parseFloat(found[1]);
    var walk = /^(event before|next event)$/.exec(link.textContent);
    if (walk) t = neighbour(walk[1] === 'next event', t);
    if (step) t = parseFloat(slider.value) + (link.textContent[0] === '+' ? 1 : -1) * parseFloat(step[1]);
    event.preventDefault();
    slider.value = t;
    show(t);
    keep();
    if (link.closest('#events')) document.getElementById('moment').scrollIntoView();
  });
})();
)js";
}  // namespace

const char* desk_script() { return kScript; }

}  // namespace trocar::review
