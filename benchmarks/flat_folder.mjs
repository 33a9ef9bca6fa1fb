// Flat-Folder on some files: its own pipeline, without its limit, in one process; a line of JSON per file.
// node flat_folder.mjs FOLDER_OF_FLAT_FOLDER LIMIT FILE...   (LIMIT 0: none)
import * as fs from "fs";
import * as path from "path";
import { pathToFileURL } from "url";

const [folder, limit, ...files] = process.argv.slice(2);
const at = name => pathToFileURL(path.join(folder, "src", name)).href;
const { CON } = await import(at("constraints.js"));
const { NOTE } = await import(at("note.js"));
const { BATCH } = await import(at("batch.js"));
CON.build();
NOTE.show = false;
const quiet = console.log;
for (const file of files) {
    const fold = JSON.parse(fs.readFileSync(file));
    console.log = () => {};
    const before = process.cpuUsage();
    let found = {};
    try { found = await BATCH.process_file(fold, +limit || Infinity); } catch (error) { found = { states: 0 }; }
    const used = process.cpuUsage(before);
    console.log = quiet;
    console.log(JSON.stringify({ file, states: String(found.states), seconds: (used.user + used.system) / 1e6 }));
}
