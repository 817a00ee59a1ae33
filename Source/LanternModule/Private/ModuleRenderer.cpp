#include "ModuleRenderer.h"

#include <cassert>

#include "MeshData.h"

namespace Lantern
{

namespace
{

/// Handles count from 1: 0 is none.
template <class THandle>
THandle ToHandle(uint64_t Index)
{
	return static_cast<THandle>(Index + 1);
}
template <class THandle>
uint64_t ToIndex(THandle Handle)
{
	assert(Handle != THandle::None);
	return static_cast<uint64_t>(Handle) - 1;
}

ERTObjectHandle ToHandle(FRTObjectId Id)
{
	return ToHandle<ERTObjectHandle>(uint64_t(Id.Generation) << 32 | Id.Index);
}
FRTObjectId ToId(ERTObjectHandle Handle)
{
	const uint64_t Index = ToIndex(Handle);
	return {static_cast<uint32_t>(Index), static_cast<uint32_t>(Index >> 32)};
}

glm::dmat4 ToMatrix(const double Rows[12])
{
	glm::dmat4 Matrix(1.0);
	for (int Row = 0; Row < 3; ++Row)
	{
		for (int Column = 0; Column < 4; ++Column)
		{
			Matrix[Column][Row] = Rows[Row * 4 + Column];
		}
	}
	return Matrix;
}

FView ToView(const FRTModuleFrame& Frame, uint32_t FrameIndex)
{
	const FRTModuleView& From = Frame.View;
	FView View;
	View.Position = {From.Position[0], From.Position[1], From.Position[2]};
	View.Forward = {From.Forward[0], From.Forward[1], From.Forward[2]};
	View.Up = {From.Up[0], From.Up[1], From.Up[2]};
	View.FovY = From.FovY;
	View.Near = From.Near;
	View.Width = Frame.Depth->GetDesc().Width;
	View.Height = Frame.Depth->GetDesc().Height;
	View.FrameIndex = FrameIndex;
	View.Seed = Frame.Seed;
	return View;
}

FRTStatus CheckFrame(const FRTModuleFrame& Frame)
{
	if (Frame.Commands == nullptr || Frame.Depth == nullptr || Frame.Normals == nullptr)
	{
		return FRTStatus::Error(ERTResult::InvalidArgument,
		                        "a frame needs a command list, a depth and a normal texture");
	}
	const FRTTextureDesc& Depth = Frame.Depth->GetDesc();
	const FRTTextureDesc& Normals = Frame.Normals->GetDesc();
	if (Depth.Width != Normals.Width || Depth.Height != Normals.Height)
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "depth is %u x %u, normals are %u x %u", Depth.Width,
		                        Depth.Height, Normals.Width, Normals.Height);
	}
	return FRTStatus::Success();
}

} // namespace

FModuleRenderer::FModuleRenderer(IRTModule& InOwner, IRTDevice& InDevice, FRendererDesc Desc)
    : Owner(&InOwner),
      Device(&InDevice),
      Scene(InDevice),
      Renderer(InDevice, std::move(Desc)),
      Uploader(InDevice)
{
}

FModuleRenderer::~FModuleRenderer()
{
	// Environment: a lost device can no longer be waited for, and has nothing in flight.
	(void)Renderer.WaitForAll();
}

FRTStatus FModuleRenderer::AddMaterial(const FRTModuleMaterial& Material, ERTMaterialHandle* Out)
{
	*Out = ERTMaterialHandle::None;
	const uint32_t Index = Scene.AddMaterial(PackMaterial(Material));
	MaterialTextures.resize(Index + 1);
	const ERTMaterialHandle Handle = ToHandle<ERTMaterialHandle>(Index);
	const FRTStatus Status = SetMaterial(Handle, Material);
	*Out = Status.IsOk() ? Handle : ERTMaterialHandle::None;
	return Status;
}

FRTStatus FModuleRenderer::SetMaterial(ERTMaterialHandle Handle, const FRTModuleMaterial& Material)
{
	const uint64_t Index = ToIndex(Handle);
	assert(Index < MaterialTextures.size());
	FMaterialData Data = PackMaterial(Material);
	if (Material.BaseColorTexture != nullptr)
	{
		if (Material.BaseColorSampler == nullptr || Material.BaseColorTexture->GetSampledIndex() == ~0u)
		{
			return FRTStatus::Error(ERTResult::InvalidArgument,
			                        "a material's texture needs a sampler, and to be Sampled");
		}
		Data.Textures[TEXTURE_BASE_COLOR] =
		    Material.BaseColorTexture->GetSampledIndex() | Material.BaseColorSampler->GetIndex() << 24;
	}
	MaterialTextures[Index] = {TRTRef(Material.BaseColorTexture), TRTRef(Material.BaseColorSampler)};
	Scene.SetMaterial(static_cast<uint32_t>(Index), Data);
	return FRTStatus::Success();
}

FRTStatus FModuleRenderer::AddMesh(const FRTModuleMesh& Mesh, ERTMeshHandle* Out)
{
	*Out = ERTMeshHandle::None;
	if (const FRTStatus Status = CheckMesh(Mesh); !Status)
	{
		return Status;
	}
	constexpr ERTBufferUsage Usage = ERTBufferUsage::GeometryInput | ERTBufferUsage::Storage;
	const std::vector<FVertexAttributes> Attributes = PackAttributes(Mesh);
	FRTGeometryInfo Info;
	Info.Name = Mesh.Name;
	Info.VertexCount = Mesh.VertexCount;
	Info.Sections = MakeSections(Mesh);
	const uint64_t PositionBytes = uint64_t(Mesh.VertexCount) * 12;
	FRTStatus Status = Uploader.CreateBuffer(Mesh.Name, Usage, Mesh.Positions, PositionBytes, Info.Positions);
	if (Status)
	{
		Status = Uploader.CreateBuffer(Mesh.Name, Usage, Attributes.data(),
		                               Attributes.size() * sizeof(FVertexAttributes), Info.Attributes);
	}
	if (Status)
	{
		Status = Uploader.CreateBuffer(Mesh.Name, Usage | ERTBufferUsage::Index, Mesh.Indices,
		                               uint64_t(Mesh.IndexCount) * 4, Info.Indices);
	}
	if (Status)
	{
		Status = Uploader.Flush();
	}
	FRTGeometryRef Geometry;
	if (Status)
	{
		Status = Scene.CreateGeometry(std::move(Info), Geometry);
	}
	if (Status)
	{
		Meshes.push_back(std::move(Geometry));
		*Out = ToHandle<ERTMeshHandle>(Meshes.size() - 1);
	}
	return Status;
}

void FModuleRenderer::RemoveMesh(ERTMeshHandle Handle)
{
	assert(ToIndex(Handle) < Meshes.size() && Meshes[ToIndex(Handle)]);
	Meshes[ToIndex(Handle)] = nullptr;
}

FRTStatus FModuleRenderer::AddObject(const FRTModuleObject& Object, ERTObjectHandle* Out)
{
	*Out = ERTObjectHandle::None;
	FRTObjectInfo Info;
	Info.Geometry = Meshes.at(ToIndex(Object.Mesh));
	assert(Info.Geometry);
	if (Object.MaterialCount != Info.Geometry->GetSectionCount())
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "an object of \"%s\" needs %u materials, not %u",
		                        Info.Geometry->GetInfo().Name.c_str(), Info.Geometry->GetSectionCount(),
		                        Object.MaterialCount);
	}
	for (uint32_t Section = 0; Section < Object.MaterialCount; ++Section)
	{
		Info.Materials.push_back(static_cast<uint32_t>(ToIndex(Object.Materials[Section])));
	}
	Info.Transform = ToMatrix(Object.Transform);
	Info.Mask = Object.bCastsShadow ? MaskAll : MaskVisible;
	*Out = ToHandle(Scene.AddObject(std::move(Info)));
	return FRTStatus::Success();
}

void FModuleRenderer::SetObjectTransform(ERTObjectHandle Handle, const double Transform[12])
{
	Scene.SetTransform(ToId(Handle), ToMatrix(Transform));
}

void FModuleRenderer::RemoveObject(ERTObjectHandle Handle)
{
	Scene.RemoveObject(ToId(Handle));
}

void FModuleRenderer::SetSun(const FRTModuleSun& Sun)
{
	FSunLight Light;
	Light.Direction = {Sun.Direction[0], Sun.Direction[1], Sun.Direction[2]};
	Light.Color = {Sun.Color[0], Sun.Color[1], Sun.Color[2]};
	Light.Irradiance = Sun.Irradiance;
	Light.AngularDiameter = Sun.AngularDiameter;
	Scene.SetSun(Light);
}

void FModuleRenderer::AddPasses(const FRTModuleFrame& Frame)
{
	FFrameContext& Context = Renderer.GetContext();
	FFrameGraph& Graph = Context.Graph;
	FSunShadowInputs Inputs;
	Inputs.Depth = Graph.ImportTexture(Frame.Depth, Frame.DepthAccess, ERTAccess::ShaderRead, "EngineDepth");
	Inputs.Normals = Graph.ImportTexture(Frame.Normals, Frame.NormalsAccess, ERTAccess::ShaderRead, "EngineNormals");
	const FGraphTexture Visibility = AddSunShadowPass(Context, Inputs).Visibility;
	if (!Visibility.IsValid())
	{
		return;
	}
	// The engine reads it after the graph has ended: the last pass leaves it readable and holds on to it.
	Graph.AddPass("HandToEngine",
	              [this, Visibility](FPassBuilder& Builder) -> FPassExecute
	              {
		              Builder.Read(Visibility, ERTAccess::ShaderRead);
		              Builder.NeverCull();
		              return [this, Visibility](FPassContext& Pass)
		              { SunShadow = TRTRef<IRTTexture>(Pass.GetTexture(Visibility)); };
	              });
}

FRTStatus FModuleRenderer::RenderFrame(const FRTModuleFrame& Frame, FRTModuleOutputs* Out)
{
	*Out = {};
	SunShadow = nullptr;
	assert(!Recorded && "EndFrame was not called");
	if (const FRTStatus Status = CheckFrame(Frame); !Status)
	{
		return Status;
	}
	if (const FRTStatus Status = Renderer.BeginFrame(Scene, ToView(Frame, FrameIndex++), {}); !Status)
	{
		return Status;
	}
	AddPasses(Frame);
	const FRTStatus Status = Renderer.EndFrame(*Frame.Commands);
	if (!Status)
	{
		SunShadow = nullptr;
		Renderer.FrameSubmitted(0); // it never will be
		return Status;
	}
	Recorded = TRTRef<IRTCommandList>(Frame.Commands);
	Out->SunShadow = SunShadow.Get();
	Out->bComplete = true;
	return Status;
}

FRTStatus FModuleRenderer::EndFrame(FRTFence* OutFence)
{
	assert(Recorded && "RenderFrame was not called");
	IRTCommandList* List = Recorded.Get();
	FRTFence Fence = 0;
	const FRTStatus Status = Device->NotifyExternalSubmit(&List, 1, &Fence);
	Renderer.FrameSubmitted(Fence);
	Recorded = nullptr;
	if (OutFence != nullptr)
	{
		*OutFence = Fence;
	}
	return Status;
}

} // namespace Lantern
