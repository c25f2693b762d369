// Prints a file as npm packages read it, as JSON. usage: node read_file.js glb|schem|vox FILE [VERSION OF
// MINECRAFT]
const fs = require('fs')

async function readGlb (bytes) {
  const report = await require('gltf-validator').validateBytes(new Uint8Array(bytes))
  return { issues: report.issues, info: report.info }
}

// Names and properties of all blocks in the order of y, z, x of Minecraft.
async function readSchem (bytes, version) {
  const { Schematic } = require('prismarine-schematic')
  const schematic = await Schematic.read(bytes, version)
  const { Vec3 } = require('vec3')
  const start = schematic.start()
  const result = { size: schematic.size.toArray(), blocks: [] }
  for (let y = 0; y < schematic.size.y; y++) {
    for (let z = 0; z < schematic.size.z; z++) {
      for (let x = 0; x < schematic.size.x; x++) {
        const block = schematic.getBlock(start.plus(new Vec3(x, y, z)))
        result.blocks.push(block.name + JSON.stringify(block.getProperties()))
      }
    }
  }
  return result
}

function readVox (bytes) {
  const vox = require('vox-reader').default ?? require('vox-reader')
  const file = vox([...bytes])
  const list = (part) => part === undefined ? [] : Array.isArray(part) ? part : [part]
  return { sizes: list(file.size), voxels: list(file.xyzi).map((model) => model.values), colors: file.rgba?.values }
}

const [format, path, version] = process.argv.slice(2)
Promise.resolve({ glb: readGlb, schem: readSchem, vox: readVox }[format](fs.readFileSync(path), version))
  .then((result) => console.log(JSON.stringify(result)))
