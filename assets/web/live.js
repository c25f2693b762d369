// Live data from the server: players, places, and blocks that are being edited.
'use strict';
(() => {
  const {world, map, drawnAt, text, onEdits} = terrane;
  const players = new Map(), places = new Map();
  const markers = L.layerGroup().addTo(map);

  // A color derived from the name.
  function colorOf(name) {
    let hash = 0;
    for (const letter of name) hash = (hash * 31 + letter.codePointAt(0)) % 360;
    return `hsl(${hash} 70% 50%)`;
  }
  // Names come from players and are inserted as text, never as HTML.
  function icon(kind, name, color) {
    const element = document.createElement('div'), pin = document.createElement('i'), label = document.createElement('span');
    if (color) pin.style.setProperty('--color', color);
    label.textContent = name;
    element.className = kind;
    element.append(pin, label);
    return L.divIcon({className: '', html: element, iconSize: [0, 0], iconAnchor: [9, 9]});
  }
  function mark(entries, key, place, kind, color) {
    let marker = entries.get(key);
    if (!marker) {
      marker = L.marker(drawnAt(place), {icon: icon(kind, place.name, color), keyboard: false, alt: place.name});
      markers.addLayer(marker);
      entries.set(key, marker);
    }
    marker.place = place;
    marker.setLatLng(drawnAt(place));
  }
  // Different places may have equal names: a counter makes the keys unique.
  function showAll(entries, found, kind, color) {
    const counts = new Map(), keys = found.map(place => {
      const count = (counts.get(place.name) ?? 0) + 1;
      counts.set(place.name, count);
      return `${kind(place)} ${count} ${place.name}`;
    });
    for (const [key, marker] of entries) {
      if (keys.includes(key)) continue;
      markers.removeLayer(marker);
      entries.delete(key);
    }
    found.forEach((place, k) => mark(entries, keys[k], place, kind(place), color(place)));
    map.fire('live');
  }
  map.on('base', () => {
    for (const marker of [...players.values(), ...places.values()]) marker.setLatLng(drawnAt(marker.place));
  });
  const showPlayers = found => showAll(players, found, () => 'player', place => colorOf(place.name));
  const showPlaces = found => showAll(places, found, place => (place.isSpawn ? 'named spawn' : 'named'), () => null);
  const spawn = {...world.spawn, name: text('spawn'), isSpawn: true};

  const notice = document.getElementById('notice');
  let words = '', isLost = false;
  function showNotice() {
    notice.textContent = isLost ? text('lost') : words;
    notice.hidden = !notice.textContent;
  }
  function say(newWords) {
    words = newWords;
    showNotice();
  }

  // Browsers limit the connections per host: a hidden page closes its own.
  let events = null, waiting = 0;
  function listen() {
    clearTimeout(waiting);
    events?.close();
    events = null;
    if (document.hidden) return;
    events = new EventSource('api/edits');
    events.addEventListener('open', () => { isLost = false; showNotice(); });
    events.addEventListener('error', () => {
      isLost = true;
      showNotice();
      // Some error responses stop the browser's automatic reconnection.
      if (events.readyState === EventSource.CLOSED) waiting = setTimeout(listen, 2000 + 4000 * Math.random());
    });
    events.addEventListener('players', event => showPlayers(JSON.parse(event.data)));
    events.addEventListener('places', event => showPlaces([spawn, ...JSON.parse(event.data)]));
    events.addEventListener('edits', event => onEdits(JSON.parse(event.data)));
  }

  terrane.live = {players, places, markers, say};
  terrane.startLive = () => {
    showPlaces([spawn, ...(world.places || [])]);
    if (!world.isLive) return;
    document.addEventListener('visibilitychange', listen);
    listen();
  };
})();
