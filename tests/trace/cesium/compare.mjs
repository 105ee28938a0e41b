// Compares the counts of two recordings: node compare.mjs OLD.json NEW.json
// Exits with 1 if they differ by more than another version of the browser or of GDAL may change.
import { readFileSync } from "node:fs";

const [before, after] = process.argv.slice(2).map((path) => JSON.parse(readFileSync(path, "utf8")));
const problems = [];
function expectNear(what, get, share) {
    const [old, now] = [get(before), get(after)];
    if (!(Math.abs(now - old) <= share * Math.max(Math.abs(old), 1)))
        problems.push(`${what}: ${now}; expected ${old}, to ${100 * share} %`);
}
expectNear("frames", ({ frames }) => frames, 0);
expectNear("finest level with data", ({ maxLevel }) => maxLevel, 0);
expectNear("holes", ({ holes }) => holes, 0);
expectNear("refined tiles below the tolerance", ({ refinedBelowTau }) => refinedBelowTau, 0);
expectNear("finest drawn level", ({ deepestDrawn }) => deepestDrawn, 0.1);
expectNear("drawn tiles", ({ drawn }) => drawn, 0.05);
expectNear("different drawn tiles", ({ distinctDrawn }) => distinctDrawn, 0.05);
expectNear("requests of heights", ({ heightRequests }) => heightRequests, 0.05);
expectNear("tiles that wait for descendants", ({ coarse }) => coarse.waits, 0.15);
expectNear("tiles without finer data", ({ coarse }) => coarse.withoutData, 0.15);
for (const problem of problems) console.error(`compare.mjs: ${problem}`);
if (problems.length > 0) process.exit(1);
console.log(JSON.stringify(before) === JSON.stringify(after) ? "the counts are the same" : "the counts differ by little");
