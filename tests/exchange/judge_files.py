#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""judge_files.py PROGRAM: MaterialX files in MaterialX' own validator, against its own library of
nodes, and OpenMATERIAL files against a schema of what the format asks for. Runs in a virtual
environment that has materialx and jsonschema; see run_judge.py."""
import json
import subprocess
import sys
import tempfile

import jsonschema
import MaterialX as mx

program = sys.argv[1]

ANGLE = {"type": "number", "minimum": 0, "maximum": 1.570796}
TEXT = {"type": "string", "minLength": 1}
WAVELENGTH = {"type": "number", "minimum": 1e-9, "maximum": 17.16e-3}
VERSION = {"type": "string", "pattern": r"^\d+\.\d+\.\d+$"}
SCHEMA = {
    "$schema": "http://json-schema.org/draft-07/schema#",
    "type": "object", "required": ["metadata", "brdf"],
    "properties": {
        "metadata": {
            "type": "object",
            "required": ["name", "uuid", "materialVersion", "openMaterial3dVersion", "copyrights",
                         "license", "authors", "sources"],
            "properties": {
                "name": TEXT, "license": TEXT, "sources": TEXT, "materialVersion": VERSION,
                "openMaterial3dVersion": VERSION,
                "uuid": {"type": "string",
                         "pattern": "^[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}$"},
                "copyrights": {"type": "array", "items": TEXT, "minItems": 1},
                "authors": {"type": "array", "items": TEXT, "minItems": 1}}},
        "brdf": {
            "type": "object", "required": ["wavelengths", "lookupTable"],
            "properties": {
                "wavelengths": {"type": "array", "items": WAVELENGTH, "minItems": 1},
                "lookupTable": {
                    "type": "array", "minItems": 1,
                    "items": {
                        "type": "array", "minItems": 5, "maxItems": 5,
                        "items": [WAVELENGTH, ANGLE, ANGLE,
                                  {"type": "number", "minimum": 0, "maximum": 6.283185},
                                  {"type": "number", "minimum": 0}]}}}}},
}


def export(folder, model, name, *options):
    path = f"{folder}/{name}"
    subprocess.run([program, "export", model, "-o", path, "--quiet", *options], check=True)
    return path


def check_materialx(folder):
    library = mx.createDocument()
    mx.loadLibraries(mx.getDefaultDataLibraryFolders(), mx.getDefaultDataSearchPath(), library)
    for model in ("ggx:alpha=0.09,material=Au", "ggx:alpha=0.4,alpha_y=0.2", "ggx:alpha=0.2,ior=1.5"):
        document = mx.createDocument()
        mx.readFromXmlFile(document, export(folder, model, "m.mtlx"))
        document.importLibrary(library)
        valid, message = document.validate()
        assert valid, message
        shader = document.getNode("surface_shader")
        definition = shader.getNodeDef()
        assert definition is not None, "no definition of the node takes these inputs"
        for given in shader.getInputs():
            known = definition.getActiveInput(given.getName())
            assert known is not None and known.getType() == given.getType(), given.getName()
        roughness = shader.getInputValue("specular_roughness")
        anisotropy = shader.getInputValue("specular_roughness_anisotropy")
        # The node's own widths, as its implementation computes them.
        wide = roughness**2 * (2 / (1 + (1 - anisotropy) ** 2)) ** 0.5
        alpha = float(model.split("alpha=")[1].split(",")[0])
        print(f"{model}: valid, roughness {roughness:.4f}, alpha of the node {wide:.5f}")
        assert abs(wide - alpha) < 1e-5


def check_openmaterial(folder):
    path = export(folder, "ggx:alpha=0.5,f0=0.9/0.6/0.3", "m.json", "--format",
                  "openmaterial:step=15")
    with open(path) as file:
        table = json.load(file)
    jsonschema.Draft7Validator(SCHEMA).validate(table)
    rows = table["brdf"]["lookupTable"]
    assert rows == sorted(rows), "rows do not stand in the order of their columns"
    print(f"OpenMATERIAL: {len(rows)} rows as the format asks for")


with tempfile.TemporaryDirectory() as folder:
    check_materialx(folder)
    check_openmaterial(folder)
