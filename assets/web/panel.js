// The panel: views, overlays, players, named places, search.
'use strict';
(() => {
  const {world, map, text, bases, overlays, showBase, showOverlay, go, live} = terrane;
  const byId = id => document.getElementById(id);

  for (const element of document.querySelectorAll('[data-text]')) element.textContent = text(element.dataset.text);
  byId('query').placeholder = text('search');
  byId('query').setAttribute('aria-label', text('search'));
  byId('open').title = text('layers');
  byId('open').setAttribute('aria-label', text('layers'));
  byId('world').textContent = world.name;
  byId('about').textContent = text('about', world);
  document.title = `${world.name} – Terrane`;

  function option(group, kind, name, label, isOn, choose) {
    const element = document.createElement('label'), input = document.createElement('input');
    Object.assign(input, {type: kind, name: group, value: name, checked: isOn});
    input.addEventListener('change', () => choose(input.checked));
    element.append(input, label);
    byId(group).append(element);
    return input;
  }
  const baseInputs = Object.keys(bases).map(
    name => option('bases', 'radio', name, text(name), false, () => showBase(name)));
  const overlayInputs = Object.keys(overlays).map(
    name => option('overlays', 'checkbox', name, text(name), false, isOn => showOverlay(name, isOn)));
  option('overlays', 'checkbox', 'markers', text('markers'), true,
    isOn => (isOn ? live.markers.addTo(map) : live.markers.remove()));
  map.on('base', () => {
    for (const input of baseInputs) input.checked = input.value === terrane.base();
    for (const input of overlayInputs) {
      input.checked = map.hasLayer(overlays[input.value]);
      input.disabled = terrane.base() === 'isometric';
    }
  });

  // Sets a property of the element to the names; true if they are other names than before. Players move every
  // second: a row that is replaced meanwhile loses the focus and the click.
  function hasOtherNames(element, names) {
    const before = element.dataset.names;
    element.dataset.names = JSON.stringify(names);
    return element.dataset.names !== before;
  }

  function list(section, entries, nothing) {
    if (!hasOtherNames(section, [...entries.keys()])) return;
    const rows = [...entries.values()].map(marker => {
      const row = document.createElement('li'), button = document.createElement('button');
      button.type = 'button';
      button.textContent = marker.place.name;
      button.addEventListener('click', () => go(marker.place));
      row.append(button);
      return row;
    });
    if (rows.length === 0) {
      const row = document.createElement('li');
      row.textContent = nothing;
      rows.push(row);
    }
    section.querySelector('ul').replaceChildren(...rows);
  }
  byId('playing').hidden = !world.isLive;
  map.on('live', () => {
    list(byId('playing'), live.players, text('nobody'));
    list(byId('named'), live.places, text('noPlaces'));
    const names = [...live.players.values(), ...live.places.values()].map(({place}) => place.name);
    if (!hasOtherNames(byId('names'), names)) return;
    byId('names').replaceChildren(...names.map(name => {
      const choice = document.createElement('option');
      choice.value = name;
      return choice;
    }));
  });

  // Accepts two coordinates, or the name of a player or place, or its beginning.
  function find(query) {
    const numbers = query.match(/^\s*(-?\d+)[\s,;]+(-?\d+)\s*$/);
    if (numbers) return {x: Number(numbers[1]), y: Number(numbers[2])};
    const wanted = query.trim().toLowerCase();
    const all = [...live.players.values(), ...live.places.values()].map(marker => marker.place);
    return all.find(({name}) => name.toLowerCase() === wanted) ??
      all.find(({name}) => name.toLowerCase().startsWith(wanted));
  }
  byId('search').addEventListener('submit', event => {
    event.preventDefault();
    const query = byId('query').value;
    if (!query.trim()) return;
    const place = find(query);
    live.say(place ? '' : text('notFound', {query}));
    if (!place) return;
    go(place);
    byId('map').focus();
  });

  terrane.togglePanel = () => {
    const panel = byId('panel');
    panel.hidden = !panel.hidden;
    byId('open').setAttribute('aria-expanded', String(!panel.hidden));
  };
  byId('open').addEventListener('click', terrane.togglePanel);
})();
