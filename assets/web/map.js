// The map: coordinates, tile layers, links to places. Used by live.js, panel.js and tools.js.
//
// A place is {x, y} in blocks. North (-y) is up and east (-x) is right, as on the game's compass.
'use strict';
const terrane = (() => {
  const world = window.terraneWorld;
  let seen = world.edits;  // number of the last edit event shown
  const text = terraneTexts.text;

  const latLng = place => L.latLng(-place.y, -place.x);
  const placeOf = at => ({x: -at.lng, y: -at.lat});

  // Blocks to pixels of zoom 0. The isometric view looks northwest and down: see terrane/map/isometric.h.
  const above = {
    project: at => L.point(at.lng, -at.lat),
    unproject: point => L.latLng(-point.y, point.x),
  };
  const isometric = {
    seaLevel: world.seaLevel * world.isometricHeight,
    project: at => L.point(at.lng + at.lat, (at.lng - at.lat) / 2 - isometric.seaLevel),
    unproject(point) {
      const sum = 2 * (point.y + isometric.seaLevel), difference = point.x;
      return L.latLng((difference - sum) / 2, (difference + sum) / 2);
    },
  };
  const crsOf = projection => L.Util.extend({}, L.CRS.Simple, {
    projection: {...projection, bounds: L.bounds([-2147483648, -2147483648], [2147483648, 2147483648])},
    transformation: L.transformation(1, 0, 1, 0),
  });
  const crs = {above: crsOf(above), isometric: crsOf(isometric)};

  const map = L.map('map', {
    crs: crs.above, minZoom: world.minZoom, maxZoom: world.maxZoom + 2, zoomControl: true, attributionControl: false,
    zoomSnap: 1, keyboardPanDelta: 160, inertia: true, worldCopyJump: false,
    fadeAnimation: !matchMedia('(prefers-reduced-motion: reduce)').matches,
  });

  // A server has tiles of the whole world, a folder of files only those of an area
  // (terrane/map/map_tile.h). Second argument: the tile's bounds in pixels of zoom 0.
  const [lowest, highest] = [world.bottom, world.top].map(z => z * world.isometricHeight);
  const area = world.area ?? {x0: -2147483648, y0: -2147483648, x1: 2147483648, y1: 2147483648};
  const meet = (low, high, otherLow, otherHigh) => low < otherHigh && otherLow < high;
  function isInArea(name, {min, max}) {
    if (name !== 'isometric') return meet(min.x, max.x, -area.x1, -area.x0) && meet(min.y, max.y, area.y0, area.y1);
    const top = min.y + lowest, bottom = max.y + highest;
    return meet(min.x, max.x, -area.x1 - area.y1, -area.x0 - area.y0) &&
      meet(min.y, max.y, (area.y0 - area.x1) / 2 - highest, (area.y1 - area.x0) / 2 - lowest) &&
      meet(-max.x / 2 - bottom, -min.x / 2 - top, area.x0, area.x1) &&
      meet(top - max.x / 2, bottom - min.x / 2, area.y0, area.y1);
  }

  // Tiles are numbered by the blocks that they show. A changed tile is reloaded in place to avoid flicker.
  const Tiles = L.TileLayer.extend({
    getTileUrl(coords) {
      const isSeenFromAbove = this.options.name !== 'isometric';
      const x = isSeenFromAbove ? -coords.x - 1 : coords.x;
      return `tiles/${this.options.name}/${this._getZoomForUrl()}/${x}/${coords.y}.png`;
    },
    _isValidTile(coords) {
      const zoom = this._getZoomForUrl(), size = 256 / 2 ** zoom;
      const tile = L.bounds([coords.x * size, coords.y * size], [(coords.x + 1) * size, (coords.y + 1) * size]);
      return L.TileLayer.prototype._isValidTile.call(this, coords) && isInArea(this.options.name, tile);
    },
    // Reloads a tile in place to avoid flicker; only the last of several requests counts. Retries after
    // errors.
    loadAgain(tile) {
      const number = tile.reloads = (tile.reloads ?? 0) + 1;
      const isLast = () => tile.reloads === number && this._tiles[this._tileCoordsToKey(tile.coords)] === tile;
      const image = new Image();
      image.onload = () => { if (isLast()) tile.el.src = image.src; };
      image.onerror = () => setTimeout(() => { if (isLast()) this.loadAgain(tile); }, 3000 + 3000 * Math.random());
      image.src = `${this.getTileUrl(tile.coords)}?${seen}-${number}`;
    },
    // Reloads the tiles for which isTouched(coords) is true.
    reload(isTouched) {
      for (const tile of Object.values(this._tiles)) if (isTouched(tile.coords)) this.loadAgain(tile);
    },
    // Leaflet fades in each loaded tile: skip this after a reload.
    _tileReady(coords, error, element) {
      const tile = this._tiles[this._tileCoordsToKey(coords)];
      const isIts = tile?.el === element;  // not of an earlier tile at these coords
      if (isIts && tile.isShown) return;
      L.TileLayer.prototype._tileReady.call(this, coords, error, element);
      if (!isIts) return;
      if (!error) tile.isShown = true;
      else if (world.isLive) this.loadAgain(tile);
    },
  });
  const tiles = (name, options) => new Tiles('', {
    name, tileSize: 256, minZoom: world.minZoom, maxZoom: world.maxZoom + 2, minNativeZoom: world.minZoom,
    maxNativeZoom: world.maxZoom, keepBuffer: 2, updateWhenZooming: false, className: name, ...options,
  });
  const bases = {}, overlays = {};
  for (const name of world.layers) {
    if (['height', 'biome'].includes(name)) overlays[name] = tiles(name, {opacity: 0.6, zIndex: 5});
    else bases[name] = tiles(name);
  }

  let base = null;
  const projectionOf = name => (name === 'isometric' ? 'isometric' : 'above');
  function showBase(name) {
    if (!bases[name] || name === base) return;
    const center = map.options.crs && base ? map.getCenter() : null;
    if (base) bases[base].remove();
    const isOther = projectionOf(name) !== projectionOf(base);
    base = name;
    map.options.crs = crs[projectionOf(name)];
    if (isOther && center) map.setView(center, map.getZoom(), {reset: true, animate: false});
    if (isOther) map.fire('projection');
    bases[name].addTo(map);
    for (const overlay of Object.values(overlays)) if (name === 'isometric') overlay.remove();
    map.fire('base');
  }
  function showOverlay(name, isShown) {
    if (!overlays[name]) return;
    if (isShown && base !== 'isometric') overlays[name].addTo(map);
    else overlays[name].remove();
    map.fire('base');
  }

  // Links: #x,y,zoom,layer,overlay…
  function link() {
    const {x, y} = placeOf(map.getCenter());
    const shown = Object.keys(overlays).filter(name => map.hasLayer(overlays[name]));
    return `#${[Math.round(x), Math.round(y), map.getZoom(), base, ...shown].join(',')}`;
  }
  function follow(hash) {
    const [x, y, zoom, layer, ...shown] = hash.replace(/^#/, '').split(',');
    const numbers = [x, y, zoom].map(Number);
    if (!x || numbers.some(number => !Number.isFinite(number))) return false;
    showBase(bases[layer] ? layer : base || world.layers[0]);
    map.setView(latLng({x: numbers[0], y: numbers[1]}), numbers[2], {animate: false});
    for (const name of Object.keys(overlays)) showOverlay(name, shown.includes(name));
    return true;
  }
  // The drawn position of a place: the isometric view shifts high places up.
  function drawnAt(place) {
    const up = base === 'isometric' && place.z !== undefined ? (place.z - world.seaLevel) * world.isometricHeight : 0;
    return latLng({x: place.x + up, y: place.y - up});
  }
  function go(place, zoom) {
    map.setView(drawnAt(place), zoom ?? Math.max(map.getZoom(), 0));
  }

  function start() {
    showBase(world.layers[0]);
    map.setView(latLng(world.spawn), Math.max(world.minZoom, -2));
    follow(location.hash);
    const keep = () => history.replaceState(null, '', link());
    map.on('moveend base', keep);
    window.addEventListener('hashchange', () => { if (location.hash !== link()) follow(location.hash); });
    keep();
  }

  const shownLayers = () => [bases[base], ...Object.values(overlays)].filter(layer => map.hasLayer(layer));
  const levelOf = zoom => Math.max(-zoom, 0);

  // Reloads the tiles that show part of a box {level, x0, y0, x1, y1}, in blocks, bounds inclusive.
  function reload(box) {
    const corners = [[box.x0, box.y0], [box.x1 + 1, box.y0], [box.x0, box.y1 + 1], [box.x1 + 1, box.y1 + 1]];
    const bounds = L.bounds(corners.map(([x, y]) => map.options.crs.projection.project(latLng({x, y}))));
    // Light reaches 16 columns; in the isometric view, buildings extend up by the height of the world.
    const margin = 16 * 2 ** box.level, top = base === 'isometric' ? height : 0;
    for (const layer of shownLayers()) {
      layer.reload(({x, y, z}) => {
        const size = 256 / 2 ** z;
        return levelOf(z) === box.level &&
          (x + 1) * size >= bounds.min.x - margin && x * size <= bounds.max.x + margin &&
          (y + 1) * size >= bounds.min.y - top - margin && y * size <= bounds.max.y + top + margin;
      });
    }
  }
  // Edit events are numbered. If some were missed, everything is reloaded.
  function onEdits({number, boxes}) {
    const isNext = number === seen + 1, isKnown = number === seen;
    seen = number;
    if (isNext) boxes.forEach(reload);
    else if (!isKnown) for (const layer of shownLayers()) layer.reload(() => true);
  }

  return {world, text, map, bases, overlays, latLng, drawnAt, placeOf, showBase, showOverlay, go, start, onEdits, link,
    base: () => base};
})();
