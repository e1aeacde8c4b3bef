'use strict'
// The web page that plays: prismarine-web-client with three of its defects mended, and its way to the game server.

const fs = require('fs')
const path = require('path')
const express = require('express')
const netApi = require('net-browserify')
const { patchedOnce } = require('./patch')

const CLIENT_PATCHES = [
  // Typed in chat, a digit chose a hotbar slot, and a period or colon stopped the client with an error.
  ['const t=e.code.substr(5);t<1||t>9||',
    'const t=/^Digit[1-9]$/.test(e.code)&&!document.getElementById("hud").shadowRoot.querySelector("#chat").inChat?+e.code[5]:0;t<1||t>9||'],
  // Its delay between two placings by a held button never worked: a click of 0.1 s placed two blocks.
  ['e.lastPlaced=0', 'this.lastPlaced=0'],
  // A block that can't be placed there stopped the client with an error; in the game nothing happens then.
  ['e._placeBlockWithOptions(t,a[t.face],{delta:n,forceLook:"ignore"})',
    'e._placeBlockWithOptions(t,a[t.face],{delta:n,forceLook:"ignore"}).catch(()=>{})'],
  // Without a graphics card most of a frame's time goes into the world's pixels: each one drawn stands for several.
  ['m.setPixelRatio(window.devicePixelRatio||1)', 'm.setPixelRatio(0.25)']
]
const PAGE_PATCHES = [['<head>', '<head><script src="/reporter.js"></script>']]

function startPage (clientFolder, gamePort, onReport) {
  const read = name => fs.readFileSync(path.join(clientFolder, name), 'utf8')
  const script = patchedOnce(read('index.js'), CLIENT_PATCHES)
  const html = patchedOnce(read('index.html'), PAGE_PATCHES)
  const app = express()
  app.use(netApi({ to: [{ host: '127.0.0.1', port: gamePort }] }))
  app.get('/', (request, response) => response.type('html').send(html))
  app.get('/index.js', (request, response) => response.type('js').send(script))
  app.get('/reporter.js', (request, response) => response.sendFile(path.join(__dirname, 'reporter.js')))
  // Its cache for playing without a network would load every file a second time.
  app.get('/service-worker.js', (request, response) => response.sendStatus(404))
  app.post('/report', express.json(), (request, response) => {
    onReport(request.body)
    response.sendStatus(204)
  })
  app.use(express.static(clientFolder))
  return new Promise((resolve, reject) => {
    const server = app.listen(0, '127.0.0.1', () => resolve(server))
    server.on('error', reject)
  })
}

module.exports = { startPage }
