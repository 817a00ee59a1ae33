// Rays start at z = 5 over (x, 0.25) and go down -z; one per column.
struct FHit { uint Value; uint Kind; uint Custom; float Distance; };
layout(buffer_reference, scalar) buffer Hits { FHit Item[]; };
layout(push_constant, scalar) uniform Push { Hits Output; uint Scene; uint Mask; uint MissValue; uint Add; float Step; };
