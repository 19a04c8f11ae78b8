#!/usr/bin/env python3
"""Holds schema/orbc-scene.schema.json and the C++ reader of scenes to the same verdicts.

  scripts/check_schema.py                         the schema against tests/scenes: good, bad/schema, bad/semantic
  scripts/check_schema.py --reader PROGRAM        and schema and reader (the program test_scene) against each other on
                                                  thousands of mutations of the good scenes
Checked besides: the schema is valid JSON Schema 2020-12; its defaults and examples satisfy it; every property is described and
occurs in a good scene. Needs python3-yaml and python3-jsonschema. Exit code 0: all agree, 1: not.
"""
import argparse
import copy
import json
import math
import os
import random
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import jsonschema
import yaml

ROOT = Path(__file__).resolve().parent.parent
SCHEMA = ROOT / "schema" / "orbc-scene.schema.json"
SCENES = ROOT / "tests" / "scenes"

# What only the reader can know: it needs the notation, another value, or the meaning of a text.
SEMANTIC = {
    "scene.no-such-wall", "scene.no-such-corner", "scene.end-wall-mirror", "scene.bad-interval", "scene.above-ceiling", "scene.mirrors-overlap",
    "scene.unknown-object", "scene.looks-at-itself", "scene.duplicate-name", "scene.bad-torus", "scene.picture-too-large", "scene.angle-out-of-range",
    "scene.not-finite", "scene.outside-space", "scene.cannot-be-masked", "scene.animation-keys",
}


class CoreLoader(yaml.SafeLoader):
    """YAML 1.2 core schema without aliases and doubled keys; keys stay the text they are, as in the reader."""

    def compose_node(self, parent, index):
        if self.check_event(yaml.AliasEvent):
            raise yaml.YAMLError("alias")
        return super().compose_node(parent, index)


CoreLoader.yaml_implicit_resolvers = {}
NUMBER = re.compile(r"^[-+]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][-+]?[0-9]+)?$")
CoreLoader.add_implicit_resolver("tag:yaml.org,2002:null", re.compile(r"^(~|null|Null|NULL|)$"), ["~", "n", "N", ""])
CoreLoader.add_implicit_resolver("tag:yaml.org,2002:bool", re.compile(r"^(true|True|TRUE|false|False|FALSE)$"), list("tTfF"))
CoreLoader.add_implicit_resolver("tag:yaml.org,2002:float", re.compile(NUMBER.pattern + r"|^[-+]?\.(inf|Inf|INF)$|^\.(nan|NaN|NAN)$"), list("-+.0123456789"))


def construct_number(loader, node):
    text = node.value.lower().replace(".inf", "inf").replace(".nan", "nan")
    value = float(text)
    if not math.isfinite(value):
        return "not a finite number"  # JSON has none
    return int(value) if value == int(value) and abs(value) < 2**53 else value


def construct_map(loader, node):
    result = {}
    for key, value in node.value:
        if not isinstance(key, yaml.ScalarNode) or key.value in result:
            raise yaml.YAMLError("bad key")
        result[key.value] = loader.construct_object(value, deep=True)
    return result


CoreLoader.add_constructor("tag:yaml.org,2002:float", construct_number)
CoreLoader.add_constructor("tag:yaml.org,2002:map", construct_map)


def load(path):
    return yaml.load(path.read_bytes().decode("utf-8-sig"), Loader=CoreLoader)


def subschemas(schema, place="#"):
    yield place, schema
    for key in ("properties", "patternProperties", "$defs"):
        for name, part in schema.get(key, {}).items():
            yield from subschemas(part, f"{place}/{key}/{name}")
    for key in ("items", "additionalProperties"):
        if isinstance(schema.get(key), dict):
            yield from subschemas(schema[key], f"{place}/{key}")
    for key in ("anyOf", "prefixItems"):
        for i, part in enumerate(schema.get(key, [])):
            yield from subschemas(part, f"{place}/{key}/{i}")


def resolved(schema, part):
    while "$ref" in part and "description" not in part:
        part = schema["$defs"][part["$ref"].rsplit("/", 1)[1]]
    return part


def keys_in(value):
    if isinstance(value, dict):
        for key, part in value.items():
            yield key
            yield from keys_in(part)
    elif isinstance(value, list):
        for part in value:
            yield from keys_in(part)


def check_schema_itself(schema, faults):
    jsonschema.Draft202012Validator.check_schema(schema)
    used = set()
    for path in sorted(SCENES.glob("good/*.yaml")):
        used.update(keys_in(load(path)))
    for place, part in subschemas(schema):
        stand_alone = dict(part, **{"$defs": schema["$defs"]})
        for value in ([part["default"]] if "default" in part else []) + part.get("examples", []):
            if not jsonschema.Draft202012Validator(stand_alone).is_valid(value):
                faults.append(f"{place}: its own default or example {value!r} is not allowed")
        for name, property_ in part.get("properties", {}).items():
            if "description" not in resolved(schema, property_) and name not in ("length", "height", "radius"):
                faults.append(f"{place}: {name} has no description")
            if name not in used:
                faults.append(f"{place}: no good scene uses {name}")


def check_corpus(validator, faults):
    count = 0
    for folder, wanted in (("good", True), ("bad/schema", False), ("bad/semantic", True)):
        for path in sorted((SCENES / folder).glob("*.yaml")):
            count += 1
            if validator.is_valid(load(path)) != wanted:
                faults.append(f"{path.relative_to(ROOT)}: the schema should {'accept' if wanted else 'refuse'} it")
    return count


VALUES = [None, True, False, 0, 1, 2, 7, -1, 0.5, -0.25, 1e9, "text", "", "none", "red", "#fff", "#ffff", "gold", "30deg", "0.5rad", "30 grad", "corner 2", "wall 1",
          "corner 0", "centre", "y", [], {}, [1, 2], [0.1, 0.2], [0.1, 0.2, 0.3], ["red", "blue"], [0.2, "30deg"], {"1": 0.1, "2": 0.2}, {"z": 0.5}, {"radius": 0.1}, {"color": "red"}]


def places_in(value, path=()):
    yield path
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, part in items:
        yield from places_in(part, path + (key,))


def mutate(scene, pool, words, dice):
    """One change somewhere: a value replaced, a key lost, misspelt, or added with a value it has elsewhere."""
    scene = copy.deepcopy(scene)
    path = dice.choice([p for p in places_in(scene) if p])
    parent = scene
    for key in path[:-1]:
        parent = parent[key]
    kind = dice.randrange(6)
    if kind == 0 and isinstance(parent, dict):
        del parent[path[-1]]
    elif kind == 1 and isinstance(parent, dict):
        parent[path[-1] + dice.choice("sx_2")] = parent.pop(path[-1])
    elif kind in (2, 3):
        target = parent[path[-1]] if isinstance(parent[path[-1]], dict) else parent
        if isinstance(target, dict):
            word = dice.choice(words)
            target[word] = dice.choice(pool.get(word, VALUES) if kind == 2 else VALUES)
    elif kind == 4 and isinstance(parent[path[-1]], list):
        target = parent[path[-1]]
        target.append(copy.deepcopy(dice.choice(target)) if target and dice.random() < 0.5 else dice.choice(VALUES))
    else:
        parent[path[-1]] = dice.choice(pool.get(path[-1], VALUES)) if dice.random() < 0.2 else dice.choice(VALUES)
    return scene


def values_by_key(value, pool):
    if isinstance(value, dict):
        for key, part in value.items():
            pool.setdefault(key, []).append(part)
            values_by_key(part, pool)
    elif isinstance(value, list):
        for part in value:
            values_by_key(part, pool)


def check_against_reader(schema, validator, reader, count, seed, faults):
    dice = random.Random(seed)
    scenes = [load(path) for path in sorted(SCENES.glob("good/*.yaml")) + sorted(SCENES.glob("bad/semantic/*.yaml"))]
    pool, words = {}, sorted({name for _, part in subschemas(schema) for name in part.get("properties", {})})
    for scene in scenes:
        values_by_key(scene, pool)
    with tempfile.TemporaryDirectory() as folder:
        mutants = {}
        for i in range(count):
            scene = mutate(dice.choice(scenes), pool, words, dice)
            name = f"{i:06}.yaml"
            mutants[name] = scene
            Path(folder, name).write_text(json.dumps(scene, ensure_ascii=False), encoding="utf-8")
        output = subprocess.run([reader, "[.verdict]"], env=dict(os.environ, ORBC_VERDICT_FOLDER=folder), capture_output=True, text=True, timeout=600, check=True).stdout
    verdicts = dict(line.split("\t")[1:] for line in output.splitlines() if line.startswith("verdict\t"))
    accepted = 0
    for name, scene in mutants.items():
        codes = set() if verdicts[name] == "ok" else {part.split(" ")[0] for part in verdicts[name].split(", ")}
        accepted += not codes
        allowed = validator.is_valid(scene)
        only_reader = all(code in SEMANTIC or code.startswith("notation.") for code in codes)
        if allowed != only_reader if allowed else not codes:
            faults.append(f"schema {'accepts' if allowed else 'refuses'}, reader says {verdicts[name]}: {json.dumps(scene, ensure_ascii=False)}")
    return accepted


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--reader", help="the built test program test_scene")
    parser.add_argument("--mutations", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    schema = json.loads(SCHEMA.read_text(encoding="utf-8"))
    validator = jsonschema.Draft202012Validator(schema)
    faults = []
    check_schema_itself(schema, faults)
    count = check_corpus(validator, faults)
    print(f"schema: {count} scenes of the corpus")
    if arguments.reader:
        accepted = check_against_reader(schema, validator, arguments.reader, arguments.mutations, arguments.seed, faults)
        print(f"schema and reader: {arguments.mutations} mutations, {accepted} of them good scenes")
    for fault in faults[:20]:
        print(f"  {fault}", file=sys.stderr)
    print("agree" if not faults else f"{len(faults)} disagreements", file=sys.stderr if faults else sys.stdout)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
