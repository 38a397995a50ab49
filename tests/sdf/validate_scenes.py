"""validate_scenes.py SCHEMA REFUSED SCENE...: an independent validator takes every scene and none of the refused."""
import json
import sys

import jsonschema

with open(sys.argv[1]) as file:
    schema = json.load(file)
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)
wrong = []
scenes = sys.argv[3:]
for path in scenes:
    with open(path) as file:
        for error in validator.iter_errors(json.load(file)):
            wrong.append(f"{path}: {error.json_path}: {error.message[:200]}")
with open(sys.argv[2]) as file:
    refused = json.load(file)
for case in refused:
    if validator.is_valid(case["scene"]):
        wrong.append(f"taken: {case['path']}: {case['rule']}")
print(f"{len(scenes)} scenes, {len(refused)} refused")
assert scenes and refused
sys.exit("\n".join(wrong) if wrong else 0)
