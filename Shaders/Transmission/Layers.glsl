// Surfaces that light shines through, in front of what the G-buffer shows.
#ifndef LANTERN_TRANSMISSION_LAYERS_GLSL
#define LANTERN_TRANSMISSION_LAYERS_GLSL

float LayerSlack = 0.0; // metres, by how much a ray goes beyond what surely lies before the G-buffer's surface

// Returns how far a camera ray looks for layers. Distance: to what the G-buffer shows, whose depth is rounded.
float DistanceOfLayers(float Distance)
{
	const float Rounding = 1.0e-4;
	LayerSlack = 2.0 * Rounding * Distance;
	return Distance * (1.0 + Rounding);
}

// Finds the next such surface along a camera ray, and returns whether there is one. It passes through the backs of single-sided ones, as
// the raster does, and through what blended ones leave clear. Glass so near to the G-buffer's surface may lie behind it. Blended surfaces lie
// on it, as decals do: the raster shows none of them where they are not solid. The ray passes what is opaque, so a blended surface shows that
// lies behind it by less than the depth's rounding.
// Origin, Left: advanced to where the ray that met it starts, and how far it may go.
bool FindLayer(FSceneConstants Scene, inout vec3 Origin, vec3 Direction, inout float Left, out FMaterialHit Hit)
{
	const uint MostBacks = 16u, MostSteps = 256u;
	uint Backs = 0u;
	for (uint Step = 0u; Step < MostSteps && Backs < MostBacks && Left > 0.0; ++Step)
	{
		SEES_HITS(true);
		Hit = TraceMaterial(Scene, MASK_TRANSMISSIVE, Origin, Direction, Left, SHOWS_ALL);
		if (Hit.Distance < 0.0) { return false; }
		bool bBack = (Hit.Flags & HIT_CULLED_SIDE) != 0u;
		if (!bBack && !IsClear(Hit))
		{
			bool bShown = IsBlended(Hit) ? Hit.Transmission > 1.0 - LeastSolidOpacity : Hit.Distance <= Left - LayerSlack;
			return bShown && (Hit.Flags & HIT_TRANSMISSIVE) != 0u; // else the raster shows it
		}
		Backs += bBack ? 1u : 0u;
		Origin = OffsetRayOrigin(Origin + Direction * Hit.Distance, -Hit.GeometricNormal, Scene.ObjectReach, Hit.Distance);
		Left -= Hit.Distance;
		WidenRayCone(Hit.Distance);
	}
	return false;
}

#endif
