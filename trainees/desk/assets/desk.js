'use strict';
// Parts that change by themselves (id "live") are asked for again and put in place of the old; without script the whole page is.
(function () {
  var live = document.getElementById('live');
  if (!live) return;
  function again() {
    var every = parseFloat(live.getAttribute('data-every'));
    if (every > 0) setTimeout(ask, 1000 * every);
  }
  function put(fresh) {
    // A picture that is there stays, so that it does not blink; one that comes is followed.
    live.querySelectorAll('img.scene').forEach(function (old) {
      fresh.querySelectorAll('img.scene').forEach(function (one) {
        if (one.getAttribute('src') === old.getAttribute('data-of')) one.parentNode.replaceChild(old, one);
      });
    });
    var at = document.activeElement, link = live.contains(at) ? at.getAttribute('href') : null;
    live.parentNode.replaceChild(fresh, live);
    live = fresh;
    follow();
    if (link) live.querySelectorAll('a').forEach(function (one) { if (one.getAttribute('href') === link) one.focus(); });
  }
  // A few pictures a second.
  function follow() {
    live.querySelectorAll('img.scene').forEach(function (picture) {
      if (picture.getAttribute('data-of')) return;
      var of = picture.getAttribute('src');
      picture.setAttribute('data-of', of);
      function next() {
        if (!document.contains(picture)) return;
        if (document.hidden) { setTimeout(next, 1000); return; }
        var fresh = new Image();
        fresh.onload = function () { picture.src = fresh.src; setTimeout(next, 300); };
        fresh.onerror = function () { setTimeout(next, 1000); };
        fresh.src = of + '?' + Date.now();
      }
      setTimeout(next, 300);
    });
  }
  function ask() {
    if (document.hidden) { again(); return; }
    var request = new XMLHttpRequest();
    request.open('GET', location.pathname + location.search);
    request.responseType = 'document';
    request.timeout = 10000;
    request.onload = function () {
      if (request.status === 401 || request.status === 403) { location.reload(); return; }
      var fresh = request.status === 200 && request.response ? request.response.getElementById('live') : null;
      if (request.status === 200 && !fresh) return;
      if (fresh) put(document.adoptNode(fresh));
      again();
    };
    request.onerror = request.ontimeout = again;
    request.send();
  }
  follow();
  again();
})();
// A sentence of the page with other numbers in it: so it stays in the page's language.
function refilled(words, values) {
  var i = 0;
  return words.replace(/[0-9]+([.,])[0-9]+/g, function (old, sign) { return i < values.length ? values[i++].replace('.', sign) : old; });
}
// A picture that follows a slider. The first one of an attempt takes some seconds, since the run is replayed before: it is asked for again.
function follower(picture) {
  var wanted = null, loading = false, tries = 0, last = picture.getAttribute('src');
  function load() {
    if (loading || wanted === null) return;
    loading = true;
    last = wanted;
    wanted = null;
    picture.src = last;
  }
  function failed() {
    loading = false;
    if (wanted === null && tries < 40) { tries += 1; setTimeout(function () { if (wanted === null) wanted = last; load(); }, 1500); }
    else load();
  }
  picture.addEventListener('load', function () { loading = false; tries = 0; load(); });
  picture.addEventListener('error', failed);
  if (picture.complete && picture.naturalWidth === 0 && picture.getAttribute('loading') !== 'lazy') failed();
  return function (t) {
    wanted = picture.getAttribute('data-base') + t.toFixed(2);
    picture.alt = refilled(picture.alt, [t.toFixed(1)]);
    load();
  };
}
document.querySelectorAll('img.patient').forEach(follower);
// Two attempts at the same moment.
(function () {
  var form = document.getElementById('together'), slider = document.getElementById('both');
  if (!form || !slider) return;
  var by = document.getElementById('by');
  if (by) by.addEventListener('change', function () { form.submit(); });
  else form.querySelector('button').hidden = true;
  var sides = [];
  document.querySelectorAll('#moment img.follows').forEach(function (picture) {
    sides.push({ show: follower(picture), shift: parseFloat(picture.getAttribute('data-shift')), length: parseFloat(picture.getAttribute('data-length')),
                 at: picture.parentNode.querySelector('output') });
  });
  var plot = document.querySelector('svg.time'), cursor = document.getElementById('cursor'), beyond = slider.getAttribute('data-words').split('; ');
  function show() {
    var t = parseFloat(slider.value);
    sides.forEach(function (side) {
      var own = Math.min(Math.max(t + side.shift, 0), side.length);
      side.show(own);
      side.at.textContent = t + side.shift < 0 ? beyond[0] : t + side.shift > side.length ? beyond[1] : own.toFixed(1) + ' s';
    });
    if (plot && cursor) {
      var end = parseFloat(plot.getAttribute('data-end')), left = parseFloat(plot.getAttribute('data-left')), right = parseFloat(plot.getAttribute('data-right'));
      cursor.setAttribute('transform', 'translate(' + (left + (right - left) * Math.min(t, end) / end).toFixed(1) + ' 0)');
    }
  }
  slider.addEventListener('input', show);
  slider.addEventListener('change', function () {
    history.replaceState(null, '', '?t=' + parseFloat(slider.value).toFixed(2) + (by ? '&by=' + by.value : ''));
  });
})();
(function () {
  var form = document.getElementById('scrub');
  var slider = document.getElementById('t');
  if (!form || !slider) return;
  var picture = document.getElementById('picture');
  var follow = picture ? follower(picture) : null;
  var cursor = document.getElementById('cursor');
  var now = document.getElementById('now');
  var plot = document.querySelector('svg.time');
  var forces = (form.getAttribute('data-force') || '').split(',');
  var end = parseFloat(plot.getAttribute('data-end')), left = parseFloat(plot.getAttribute('data-left')), right = parseFloat(plot.getAttribute('data-right'));
  var heading = document.getElementById('moment-h');
  form.querySelector('button').hidden = true;

  function show(t) {
    t = Math.min(Math.max(t, 0), end);
    if (cursor) cursor.setAttribute('transform', 'translate(' + (left + (right - left) * t / end).toFixed(1) + ' 0)');
    var slot = Math.min(forces.length - 1, Math.floor(t / end * forces.length));
    now.textContent = refilled(now.getAttribute('data-words'), [t.toFixed(1), forces[slot]]);
    if (heading) heading.textContent = refilled(heading.textContent, [t.toFixed(1)]);
    if (follow) follow(t);
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
// A list read out of a file into the field that a person may look at; without script it is pasted there.
document.querySelectorAll('[data-reads]').forEach(function (part) {
  var file = part.querySelector('input'), said = part.querySelector('output'), field = document.getElementById(part.getAttribute('data-reads'));
  part.hidden = false;
  file.addEventListener('change', function () {
    if (!file.files.length) return;
    var reader = new FileReader();
    reader.onload = function () {
      var bytes = new Uint8Array(reader.result), as = 'utf-8';
      if (bytes.length > 900000) { said.textContent = 'This file is too large: at most 900 kB are taken.'; return; }
      if (bytes[0] === 0xFF && bytes[1] === 0xFE) as = 'utf-16le';
      else if (bytes[0] === 0xFE && bytes[1] === 0xFF) as = 'utf-16be';
      try { field.value = new TextDecoder(as, { fatal: true }).decode(bytes); }
      catch (error) { as = 'windows-1252'; field.value = new TextDecoder(as).decode(bytes); }
      said.textContent = 'Read as ' + as.toUpperCase() + (as === 'utf-8' ? '.' : ': look at the letters of the names.');
    };
    reader.onerror = function () { said.textContent = 'This file cannot be read.'; };
    reader.readAsArrayBuffer(file.files[0]);
  });
});
// Everybody in a list at once.
document.querySelectorAll('[data-all]').forEach(function (part) {
  var all = part.querySelector('input'), names = part.getAttribute('data-all');
  part.hidden = false;
  all.addEventListener('change', function () {
    all.form.querySelectorAll('input[type=checkbox]').forEach(function (one) { if (one.name.indexOf(names) === 0) one.checked = all.checked; });
  });
});
