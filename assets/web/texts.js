// Texts of the page in the browser's language, with English as fallback.
'use strict';
const terraneTexts = (() => {
  const texts = {
    en: {
      search: 'x, y or a name', layers: 'Layers and places', view: 'View', overlays: 'Overlays', players: 'Players',
      places: 'Places', measure: 'Measure', full: 'Full screen', theme: 'Dark or light', help: 'Keys', close: 'Close',
      keys: 'Keys', day: 'Day', night: 'Night', isometric: 'Isometric', height: 'Heights', biome: 'Biomes',
      markers: 'Players and places', nobody: 'Nobody plays.', noPlaces: 'No place has a name. In the game: /mark NAME',
      spawn: 'Spawn', about: '{generator}, seed {seed}', notFound: 'Nothing is called “{query}”.',
      lost: 'The server does not answer. Trying again…', blocks: '{count} blocks', underWater: '{depth} blocks of water',
      start: 'Click the first point.', next: 'Click the next point; Escape ends.',
      keySearch: 'search', keyMove: 'move', keyZoom: 'zoom', keyLayers: 'layers', keyView: 'day, night, isometric',
      keyMeasure: 'measure', keyFull: 'full screen', keyTheme: 'dark or light', keySpawn: 'to the spawn', keyHelp: 'this list',
    },
    cs: {
      search: 'x, y nebo jméno', layers: 'Vrstvy a místa', view: 'Pohled', overlays: 'Překrytí', players: 'Hráči',
      places: 'Místa', measure: 'Měřit', full: 'Celá obrazovka', theme: 'Tmavá nebo světlá', help: 'Klávesy', close: 'Zavřít',
      keys: 'Klávesy', day: 'Den', night: 'Noc', isometric: 'Izometrie', height: 'Výšky', biome: 'Biomy',
      markers: 'Hráči a místa', nobody: 'Nikdo nehraje.', noPlaces: 'Žádné místo nemá jméno. Ve hře: /mark JMÉNO',
      spawn: 'Začátek', about: '{generator}, semínko {seed}', notFound: 'Nic se nejmenuje „{query}“.',
      lost: 'Server neodpovídá. Zkouším to znovu…', blocks: '{count} bloků', underWater: '{depth} bloků vody',
      start: 'Klepněte na první bod.', next: 'Klepněte na další bod; Escape končí.',
      keySearch: 'hledat', keyMove: 'posun', keyZoom: 'přiblížení', keyLayers: 'vrstvy', keyView: 'den, noc, izometrie',
      keyMeasure: 'měřit', keyFull: 'celá obrazovka', keyTheme: 'tmavá nebo světlá', keySpawn: 'na začátek', keyHelp: 'tento seznam',
    },
    de: {
      search: 'x, y oder ein Name', layers: 'Ebenen und Orte', view: 'Ansicht', overlays: 'Darüber', players: 'Spieler',
      places: 'Orte', measure: 'Messen', full: 'Vollbild', theme: 'Dunkel oder hell', help: 'Tasten', close: 'Schließen',
      keys: 'Tasten', day: 'Tag', night: 'Nacht', isometric: 'Isometrisch', height: 'Höhen', biome: 'Biome',
      markers: 'Spieler und Orte', nobody: 'Niemand spielt.', noPlaces: 'Kein Ort hat einen Namen. Im Spiel: /mark NAME',
      spawn: 'Start', about: '{generator}, Startwert {seed}', notFound: 'Nichts heißt „{query}“.',
      lost: 'Der Server antwortet nicht. Neuer Versuch…', blocks: '{count} Blöcke', underWater: '{depth} Blöcke Wasser',
      start: 'Klicke auf den ersten Punkt.', next: 'Klicke auf den nächsten Punkt; Escape beendet.',
      keySearch: 'suchen', keyMove: 'bewegen', keyZoom: 'Zoom', keyLayers: 'Ebenen', keyView: 'Tag, Nacht, isometrisch',
      keyMeasure: 'messen', keyFull: 'Vollbild', keyTheme: 'dunkel oder hell', keySpawn: 'zum Start', keyHelp: 'diese Liste',
    },
  };
  const language = (navigator.languages || ['en']).map(name => name.slice(0, 2)).find(name => texts[name]) || 'en';
  document.documentElement.lang = language;
  return {
    // The text with this key; {word} placeholders are replaced by values.
    text(name, values = {}) {
      const text = texts[language][name] ?? texts.en[name];
      return text.replace(/\{(\w+)\}/g, (_, word) => values[word]);
    },
  };
})();
