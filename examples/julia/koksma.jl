# SPDX-License-Identifier: Apache-2.0
# Points of Koksma in Julia, and their star discrepancy, without a wrapper: julia koksma.jl
mutable struct Points n::Csize_t; dim::Cint; xs::Ptr{Cdouble} end
check(status) = status == 0 || error(unsafe_string(@ccall "libkoksma".koksma_error_text()::Cstring))
xs = zeros(2, 64)                                     # a column is a point
points = Points(64, 2, pointer(xs))
pattern, star, value = zeros(UInt64, 128), zeros(UInt64, 128), zeros(128)  # room for a koksma_spec and a koksma_value
check(@ccall "libkoksma".koksma_pattern_spec("sobol:scramble=owen"::Cstring, pattern::Ptr{UInt64})::Cint)
check(@ccall "libkoksma".koksma_generate(pattern::Ptr{UInt64}, 7::UInt64, C_NULL::Ptr{Cvoid}, points::Ref{Points})::Cint)
check(@ccall "libkoksma".koksma_measure_spec("star"::Cstring, star::Ptr{UInt64})::Cint)
check(@ccall "libkoksma".koksma_evaluate(star::Ptr{UInt64}, points::Ref{Points}, C_NULL::Ptr{Cvoid}, value::Ptr{Cdouble})::Cint)
println(value[1])                                     # the first field of koksma_value
