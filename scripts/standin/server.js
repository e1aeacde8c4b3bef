'use strict'
// The stand-in's server half: a game server, the web page that plays on it, and an oracle that reads its world.
// Usage: node server.js CLIENT_FOLDER PORTS_FILE. Ports are free ones of 127.0.0.1; once all answer, they are in PORTS_FILE.

const fs = require('fs')
const { startGame } = require('./game')
const { startPage } = require('./page')
const { startOracle } = require('./oracle')

process.on('SIGTERM', () => process.exit(0))

async function main (clientFolder, portsFile) {
  const game = await startGame()
  const screen = { report: null, errors: [] }
  const page = await startPage(clientFolder, game.listeningPort, report => {
    screen.report = report
    screen.errors.push(...report.errors)
  })
  const oracle = await startOracle(game, screen)
  const ports = { game: game.listeningPort, page: page.address().port, oracle: oracle.address().port }
  fs.writeFileSync(portsFile + '.part', JSON.stringify(ports))
  fs.renameSync(portsFile + '.part', portsFile)
}

main(...process.argv.slice(2)).catch(error => {
  console.error(error.stack)
  console.error('' + error.message)
  process.exit(1)
})
