// Block under the cursor, measuring, full screen, theme, keyboard shortcuts.
'use strict';
(() => {
  const {world, map, text, placeOf, showBase, bases, go, live} = terrane;
  const byId = id => document.getElementById(id);

  // Queries the server once the cursor rests.
  let waiting = 0, asked = null;
  function showPlace(at) {
    const place = placeOf(at), x = Math.floor(place.x), y = Math.floor(place.y);
    byId('place').textContent = `${x}, ${y}`;
    clearTimeout(waiting);
    asked?.abort();
    if (!world.isLive) return;
    waiting = setTimeout(async () => {
      asked = new AbortController();
      try {
        const answer = await fetch(`api/block?x=${x}&y=${y}`, {signal: asked.signal});
        const found = await answer.json();
        if (!answer.ok) return;
        const facts = [`${x}, ${y}, ${found.z}`, found.block, found.biome];
        if (found.depth > 0) facts.push(text('underWater', {depth: found.depth}));
        byId('place').textContent = facts.filter(Boolean).join(' · ');
      } catch { /* aborted by a newer query, or no server */ }
    }, 120);
  }
  map.on('mousemove click', event => showPlace(event.latlng));
  map.on('move', () => { if (L.Browser.mobile) showPlace(map.getCenter()); });

  // Draws a polyline and shows its length in blocks.
  let line = null;
  function measure(isOn) {
    byId('measure').setAttribute('aria-pressed', String(isOn));
    byId('map').classList.toggle('measures', isOn);
    line?.remove();
    line = isOn ? L.polyline([], {color: '#e8590c', weight: 3, interactive: false}).addTo(map) : null;
    live.say(isOn ? text('start') : '');
  }
  map.on('click', event => {
    if (!line) return;
    line.addLatLng(event.latlng);
    const points = line.getLatLngs().map(placeOf);
    const length = points.slice(1).reduce((sum, p, k) => sum + Math.hypot(p.x - points[k].x, p.y - points[k].y), 0);
    live.say(points.length < 2 ? text('next') : text('blocks', {count: Math.round(length)}));
  });
  map.on('projection', () => { if (line) measure(false); });
  const toggleMeasure = () => measure(!line);
  byId('measure').addEventListener('click', toggleMeasure);

  function toggleFull() {
    if (document.fullscreenElement) document.exitFullscreen();
    else document.documentElement.requestFullscreen?.();
  }
  byId('full').addEventListener('click', toggleFull);

  const root = document.documentElement;
  const kept = {
    get: () => { try { return localStorage.getItem('theme'); } catch { return null; } },
    set: theme => { try { localStorage.setItem('theme', theme); } catch { /* storage is unavailable: not saved */ } },
  };
  if (kept.get()) root.dataset.theme = kept.get();
  function toggleTheme() {
    const isDark = root.dataset.theme ? root.dataset.theme === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
    root.dataset.theme = isDark ? 'light' : 'dark';
    kept.set(root.dataset.theme);
  }
  byId('theme').addEventListener('click', toggleTheme);

  const showHelp = () => byId('keys').showModal();
  byId('help').addEventListener('click', showHelp);
  function nextBase() {
    const names = Object.keys(bases);
    showBase(names[(names.indexOf(terrane.base()) + 1) % names.length]);
  }
  const keys = [
    ['/', 'keySearch', () => byId('query').focus()],
    ['← ↑ → ↓', 'keyMove', null],
    ['+ −', 'keyZoom', null],
    ['l', 'keyLayers', terrane.togglePanel],
    ['n', 'keyView', nextBase],
    ['m', 'keyMeasure', toggleMeasure],
    ['f', 'keyFull', toggleFull],
    ['t', 'keyTheme', toggleTheme],
    ['h', 'keySpawn', () => go(world.spawn)],
    ['?', 'keyHelp', showHelp],
  ];
  byId('keys').querySelector('dl').replaceChildren(...keys.flatMap(([key, name]) => {
    const term = document.createElement('dt'), meaning = document.createElement('dd');
    term.textContent = key;
    meaning.textContent = text(name);
    return [term, meaning];
  }));
  document.addEventListener('keydown', event => {
    if (event.key === 'Escape') {
      if (line) measure(false);
      if (event.target === byId('query')) byId('map').focus();
    }
    if (event.target instanceof HTMLInputElement && event.target.type === 'search') return;
    if (event.ctrlKey || event.altKey || event.metaKey || byId('keys').open) return;
    const found = keys.find(([key, , act]) => act && key === event.key);
    if (!found) return;
    event.preventDefault();
    found[2]();
  });

  terrane.start();
  terrane.startLive();
  byId('map').focus();
  if (matchMedia('(min-width: 900px)').matches) terrane.togglePanel();
})();
