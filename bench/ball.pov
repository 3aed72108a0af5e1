// The scene `ball` for POV-Ray (z points away from the eye there): a ball on tiles under two square lights, one shadow ray a light.
#version 3.7;
global_settings { assumed_gamma 1 ambient_light rgb 0 }
camera { perspective location <0, 2, -6> right x * image_width / image_height up y angle 2 * degrees(atan(tan(radians(20)) * image_width / image_height)) look_at <0, 1, 0> }
background { rgb 0.4 }
light_source { <-2.0271, 7.0105, -3.511> rgb 1.15 area_light <1.7, 0, 0>, <0, 0, 1.7>, 1, 1 jitter }
light_source { <4.8274, 4.7324, -1.757> rgb 0.5 area_light <1.4, 0, 0>, <0, 0, 1.4>, 1, 1 jitter }
box { <-5.5, -0.001, -5.5>, <5.5, 0, 5.5> pigment { checker rgb 0.125 rgb 0.875 } finish { diffuse 1 ambient 0 } }
sphere { <0, 1, 0>, 1 pigment { rgb 0.8 } finish { diffuse 1 ambient 0 } }
