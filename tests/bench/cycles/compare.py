"""Runs in Blender, see `run`: processor seconds against error of Cycles and of Tsuya on one scene, as CSV.

    blender --background --factory-startup --python compare.py -- TSUYA FOLDER [SIZE [SAMPLES_OF_REFERENCE]]

Seconds are user and system time: of Cycles the call that renders, of Tsuya the whole process, with relighting. For three
lamps Cycles renders three times, Tsuya once. Errors are the mean of difference^2 / (reference^2 + 0.01), each
program against its own long render; `brightness` is the mean of the picture over that of Tsuya's reference.
"""
import os
import resource
import subprocess
import sys

import bpy
import numpy as np
from mathutils import Vector

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import skirt  # noqa: E402

TSUYA, FOLDER, SIZE, REFERENCE = (sys.argv[sys.argv.index("--") + 1:] + ["512", "1024"])[:4]
SIZE, REFERENCE = int(SIZE), int(REFERENCE)
THREADS = os.cpu_count()
SAMPLES = (4, 16, 64)
STOPS = -4   # keeps the brightest pixel below 1 in a PNG


def seconds(who):
    used = resource.getrusage(who)
    return used.ru_utime + used.ru_stime


def pixels(path, linear):
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Non-Color"
    data = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(data)
    bpy.data.images.remove(image)
    grey = data.reshape(-1, 4)[:, :3].mean(axis=1).astype(np.float64)
    if linear:
        return grey
    return np.where(grey <= 0.04045, grey / 12.92, ((grey + 0.055) / 1.055) ** 2.4) / 2.0 ** STOPS


def upright(p):
    """Blender's z is up."""
    return Vector((p[0], -p[2], p[1]))


def node(material, kind, **inputs):
    made = material.node_tree.nodes.new(kind)
    for name, value in inputs.items():
        made.inputs[name].default_value = value
    return made


def material_of(name, reflectance, specular):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    out = tree.nodes.new("ShaderNodeOutputMaterial")
    body = node(material, "ShaderNodeBsdfDiffuse", Color=(reflectance, reflectance, reflectance, 1))
    if not specular:
        tree.links.new(body.outputs[0], out.inputs[0])
        return material
    # alpha along and across the tangent are roughness^2 times and over 1 - anisotropy
    middle = (skirt.ALPHA_WEFT * skirt.ALPHA_WARP) ** 0.5
    gloss = node(material, "ShaderNodeBsdfAnisotropic", Color=(1, 1, 1, 1), Roughness=middle ** 0.5,
                 Anisotropy=1 - skirt.ALPHA_WEFT / middle)
    gloss.distribution = "GGX"
    tangent = tree.nodes.new("ShaderNodeTangent")
    tangent.direction_type = "UV_MAP"
    tree.links.new(tangent.outputs[0], gloss.inputs["Tangent"])
    mix = tree.nodes.new("ShaderNodeMixShader")
    tree.links.new(node(material, "ShaderNodeFresnel", IOR=1.5).outputs[0], mix.inputs[0])
    tree.links.new(body.outputs[0], mix.inputs[1])
    tree.links.new(gloss.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], out.inputs[0])
    return material


def add_mesh(name, points, faces, material, corner_uv=None):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([upright(p) for p in points], [], faces)
    if corner_uv:
        mesh.uv_layers.new(name="UVMap").data.foreach_set("uv", [x for pair in corner_uv for x in pair])
        mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    mesh.materials.append(material)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new(name, mesh))


def look(thing, eye, target):
    thing.location = upright(eye)
    thing.rotation_euler = (upright(target) - upright(eye)).to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(thing)


def make_scene(full):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    faces = list(skirt.faces())
    add_mesh("skirt", list(skirt.points()), [[p for p, _, _ in face] for face in faces],
             material_of("ggx", skirt.DYE, True), [skirt.uv(i, j) for face in faces for _, i, j in face])
    add_mesh("plane", [(-3, 0, 3), (3, 0, 3), (3, 0, -3), (-3, 0, -3)], [(0, 1, 2, 3)],
             material_of("plane", skirt.PLANE, False))
    light = bpy.data.lights.new("key", "AREA")
    light.shape, light.size = "SQUARE", skirt.LIGHT_SIDE
    light.energy = 4 * skirt.LIGHT_SIDE ** 2 * skirt.LIGHT_RADIANCE   # Cycles divides by 4, not by pi
    look(bpy.data.objects.new("key", light), skirt.LIGHT_MIDDLE, skirt.TARGET)
    camera = bpy.data.cameras.new("camera")
    camera.angle = skirt.ANGLE
    look(bpy.data.objects.new("camera", camera), skirt.EYE, skirt.TARGET)
    scene.camera = bpy.data.objects["camera"]
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (1, 1, 1, 1)
    scene.world.node_tree.nodes["Background"].inputs[1].default_value = skirt.SKY_RADIANCE if full else 0
    scene.world.cycles_visibility.camera = True
    scene.render.engine = "CYCLES"
    scene.render.resolution_x = scene.render.resolution_y = SIZE
    scene.render.resolution_percentage = 100
    scene.render.threads_mode, scene.render.threads = "FIXED", THREADS
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    cycles = scene.cycles
    cycles.device, cycles.use_adaptive_sampling, cycles.use_denoising = "CPU", False, False
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = 3 if full else 0
    cycles.sample_clamp_indirect = cycles.sample_clamp_direct = cycles.light_sampling_threshold = 0
    cycles.blur_glossy = 0
    return scene


def render_cycles(scene, samples, seed):
    scene.cycles.samples, scene.cycles.seed = samples, seed
    scene.render.filepath = os.path.join(FOLDER, "cycles.exr")
    start = seconds(resource.RUSAGE_SELF)
    bpy.ops.render.render(write_still=True)
    spent = seconds(resource.RUSAGE_SELF) - start
    return pixels(scene.render.filepath, True), spent


def call(*words):
    subprocess.run([TSUYA, *words, "--progress", "off"], check=True, stdout=subprocess.DEVNULL)


def render_tsuya(scene_file, samples, seed, lamps):
    exr, png = os.path.join(FOLDER, "tsuya.exr"), os.path.join(FOLDER, "tsuya.png")
    start = seconds(resource.RUSAGE_CHILDREN)
    call("render", scene_file, "-o", exr, "--spp", str(samples), "--seed", str(seed), "--threads", str(THREADS))
    for lamp in ("A", "HP4", "D65")[-lamps:]:
        call("relight", exr, "--lamp", lamp, "--bits", "16", "--view", "Plain", "--exposure", str(STOPS), "-o", png)
    return pixels(png, False), seconds(resource.RUSAGE_CHILDREN) - start


def main():
    print("scene,program,lamps,samples,cpu_seconds,rel_mse,brightness", flush=True)
    for full in (False, True):
        name = "full" if full else "direct"
        scene, scene_file = make_scene(full), skirt.write(FOLDER, full, SIZE)
        exact_tsuya = render_tsuya(scene_file, REFERENCE, 77, 1)[0]
        exact_cycles = render_cycles(scene, REFERENCE, 77)[0]

        def tell(program, lamps, samples, spent, picture, exact):
            error = np.mean((picture - exact) ** 2 / (exact ** 2 + 0.01))
            print(f"{name},{program},{lamps},{samples},{spent:.3f},{error:.3e},"
                  f"{picture.mean() / exact_tsuya.mean():.4f}", flush=True)

        for samples in SAMPLES:
            for lamps in (1, 3):
                picture, spent = render_tsuya(scene_file, samples, 0, lamps)
                tell("tsuya", lamps, samples, spent, picture, exact_tsuya)
                renders = [render_cycles(scene, samples, seed) for seed in range(lamps)]
                tell("cycles", lamps, samples, sum(spent for _, spent in renders), renders[0][0], exact_cycles)


main()
