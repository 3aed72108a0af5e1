# SPDX-License-Identifier: Apache-2.0
"""The scene `ball` for Blender's Cycles: a ball on tiles under two square lights, direct light only, one thread.

Run by bench_blender.sh as `blender --background --factory-startup --python ball_blender.py`. Prints the processor
seconds of each of three pictures of 512 x 384 pixels and 64 samples, the making of its trees included.
"""
import math
import time

import bpy

scene = bpy.context.scene
for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)


def material(name, colour, checker=False):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    nodes.clear()
    diffuse, output = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
    links.new(diffuse.outputs[0], output.inputs[0])
    diffuse.inputs["Color"].default_value = (*colour, 1)
    if checker:
        tiles, place = nodes.new("ShaderNodeTexChecker"), nodes.new("ShaderNodeTexCoord")
        tiles.inputs["Color1"].default_value = (0.125, 0.125, 0.125, 1)
        tiles.inputs["Color2"].default_value = (0.875, 0.875, 0.875, 1)
        tiles.inputs["Scale"].default_value = 1
        links.new(place.outputs["Object"], tiles.inputs["Vector"])
        links.new(tiles.outputs["Color"], diffuse.inputs["Color"])
    return made


# Blender's z points up: (x, y, z) of ball.json is (x, -z, y) here.
bpy.ops.mesh.primitive_plane_add(size=11, location=(0, 0, 0))
bpy.context.object.data.materials.append(material("tiles", (1, 1, 1), checker=True))
bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32, radius=1, location=(0, 0, 1))
bpy.ops.object.shade_smooth()
bpy.context.object.data.materials.append(material("ball", (0.8, 0.8, 0.8)))
for place, side, power in (((-2.0271, -3.511, 7.0105), 1.7, 500), ((4.8274, -1.757, 4.7324), 1.4, 200)):
    light = bpy.data.lights.new("light", "AREA")
    light.size, light.energy = side, power
    lamp = bpy.data.objects.new("light", light)
    lamp.location = place
    scene.collection.objects.link(lamp)

camera = bpy.data.cameras.new("camera")
camera.sensor_fit = "VERTICAL"
camera.angle_y = math.radians(40)
eye = bpy.data.objects.new("camera", camera)
eye.location = (0, -6, 2)
eye.rotation_euler = (math.atan2(6, 1), 0, 0)  # towards (0, 0, 1)
scene.collection.objects.link(eye)
scene.camera = eye

scene.render.engine = "CYCLES"
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 512, 384, 100
scene.render.threads_mode, scene.render.threads = "FIXED", 1
cycles = scene.cycles
cycles.device, cycles.samples, cycles.max_bounces = "CPU", 64, 0
cycles.use_adaptive_sampling, cycles.use_denoising = False, False
cycles.pixel_filter_type = "BOX"
for _ in range(3):
    start = time.process_time()
    bpy.ops.render.render()
    print(f"seconds {time.process_time() - start:.3f}")
