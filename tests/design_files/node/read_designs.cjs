// Reads design files by another project's reader: node read_designs.cjs READER OUT FILE...
// Writes a JSON list to OUT: of each file its size, width, height and length, and the name of every block, without its
// namespace, layer by layer from the lowest on, in each row by row.

const fs = require('fs')
const { createRequire } = require('module')

const [reader, out, ...files] = process.argv.slice(2)
const fromModules = createRequire(process.cwd() + '/') // the packages lie in the folder that this is run in

async function prismarine (data) {
  const { Schematic } = fromModules('prismarine-schematic')
  const { Vec3 } = fromModules('vec3')
  const schematic = await Schematic.read(data)
  const { x: width, y: height, z: length } = schematic.size
  return [width, height, length, (x, y, z) => schematic.getBlock(schematic.start().plus(new Vec3(x, y, z))).name]
}

async function schematicjs (data) {
  const { loadSchematic } = fromModules('@enginehub/schematicjs')
  const { decode } = fromModules('@enginehub/nbt-ts')
  const plain = data[0] === 0x1f ? require('zlib').gunzipSync(data) : data
  const schematic = loadSchematic(decode(plain, { useMaps: true }).value)
  const { width, height, length } = schematic
  return [width, height, length, (x, y, z) => schematic.getBlock({ x, y, z })?.type ?? 'air']
}

async function main () {
  const found = []
  for (const file of files) {
    const [width, height, length, name] = await { prismarine, schematicjs }[reader](fs.readFileSync(file))
    const names = []
    for (let y = 0; y < height; y++) {
      for (let z = 0; z < length; z++) {
        for (let x = 0; x < width; x++) names.push(name(x, y, z))
      }
    }
    found.push({ size: [width, height, length], names })
  }
  fs.writeFileSync(out, JSON.stringify(found))
}

main()
