#!/usr/bin/env node
// Checks a glTF or GLB file with the Khronos validator and prints its report as JSON.
//   node scripts/validate_gltf.mjs FILE|-       (npm install first; works offline)
// Exit code: 0 no errors and no warnings, 1 some, 2 usage, 3 the validator is missing or the file cannot be read.
import fs from 'node:fs';
import path from 'node:path';
import { createRequire } from 'node:module';

const [file, ...rest] = process.argv.slice(2);
if (!file || rest.length) {
  console.error('usage: validate_gltf.mjs FILE|-');
  process.exit(2);
}
let validator;
try {
  validator = createRequire(import.meta.url)('gltf-validator');
} catch {
  console.error('validate_gltf: the package gltf-validator is not installed; run: npm install');
  process.exit(3);
}
try {
  const bytes = new Uint8Array(fs.readFileSync(file === '-' ? 0 : file));
  const folder = file === '-' ? '.' : path.dirname(file);
  const report = await validator.validateBytes(bytes, {
    uri: file,
    maxIssues: 100,
    externalResourceFunction: async (uri) => new Uint8Array(fs.readFileSync(path.join(folder, decodeURIComponent(uri)))),
  });
  fs.writeSync(1, JSON.stringify(report, null, 1) + '\n');
  process.exitCode = report.issues.numErrors + report.issues.numWarnings > 0 ? 1 : 0;
} catch (error) {
  // The validator throws, instead of reporting, on what is no glTF at all.
  console.error(`validate_gltf: ${file}: ${error.message ?? error}`);
  process.exitCode = error.code ? 3 : 1;
}
