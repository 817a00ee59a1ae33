// Shader execution reordering, for ray generation shaders that run material shaders. REORDER: defined if r.RT.Reorder is on and the
// device has it. Included before any declaration.
#ifdef REORDER
#extension GL_NV_shader_invocation_reorder : require
#endif
