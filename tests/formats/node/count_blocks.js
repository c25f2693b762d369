// Blocks of a region file by name, as prismarine-provider-anvil reads them, and all blocks of one chunk.
// usage: node count_blocks.js FOLDER VERSION X0 Z0 X1 Z1, an area of chunks, its end excluded; prints JSON: chunks, blocks, sample {x, z, minY, names, blocks}
const provider = require('prismarine-provider-anvil')
const { Vec3 } = require('vec3')
const legacy = require('minecraft-data/minecraft-data/data/pc/common/legacy.json').blocks

async function main (folder, version, [x0, z0, x1, z1]) {
  const registry = require('prismarine-registry')(version)
  const Anvil = provider.Anvil(version)
  const anvil = new Anvil(folder)
  const isNumbered = registry.isOlderThan('1.13')
  // Names of 1.13; for numbers that its table lacks, by data 0.
  const nameOf = (stateId) => {
    if (!isNumbered) return 'minecraft:' + registry.blocksByStateId[stateId].name
    const text = legacy[`${stateId >> 4}:${stateId & 15}`] ?? legacy[`${stateId >> 4}:0`]
    return text ? text.split('[')[0] : `id ${stateId}`
  }
  const result = { chunks: 0, blocks: {}, sample: null }
  for (let z = z0; z < z1; z++) {
    for (let x = x0; x < x1; x++) {
      const region = await anvil.getRegion(x, z)
      if (!region.hasChunk(x & 31, z & 31)) continue
      addChunk(result, await anvil.load(x, z), await anvil.loadRaw(x, z), x, z, nameOf)
    }
  }
  await anvil.close()
  console.log(JSON.stringify(result))
}

// The sections in the file; the reader adds others of air.
function sectionsOf (raw) {
  const level = (raw.value.Level ?? raw).value
  const list = (level.Sections ?? level.sections)?.value.value ?? []
  return list.filter((s) => s.block_states || s.Palette || s.Blocks).map((s) => s.Y.value)
}

function addChunk (result, chunk, raw, x, z, nameOf) {
  const sections = sectionsOf(raw)
  if (sections.length === 0) return
  result.chunks++
  const names = []
  const blocks = []
  const minY = Math.min(...sections) * 16
  const maxY = Math.max(...sections) * 16 + 16
  const isSample = !result.sample || result.chunks === 10
  const there = new Set(sections)
  const at = new Vec3(0, 0, 0)
  for (at.y = minY; at.y < maxY; at.y++) {
    const isThere = there.has(at.y >> 4)
    for (at.z = 0; at.z < 16; at.z++) {
      for (at.x = 0; at.x < 16; at.x++) {
        const name = isThere ? nameOf(chunk.getBlockStateId(at)) : 'minecraft:air'
        if (isThere) result.blocks[name] = (result.blocks[name] ?? 0) + 1
        if (!isSample) continue
        let index = names.indexOf(name)
        if (index < 0) index = names.push(name) - 1
        blocks.push(index)
      }
    }
  }
  if (isSample) result.sample = { x, z, minY, names, blocks }
}

const [folder, version, ...area] = process.argv.slice(2)
main(folder, version, area.map(Number))
