// SPDX-License-Identifier: MIT
// What the generated classes share.
using System;
using Godot;

namespace SoftBodies
{
	internal static class Native
	{
		/// <summary>A new object of a class of the addon's library.</summary>
		internal static GodotObject New(string name)
		{
			GodotObject made = ClassDB.Instantiate(name).AsGodotObject();
			if (made == null)
			{
				throw new InvalidOperationException(
					$"Godot knows no class {name}: is addons/soft_body_2d in the project, with a library for this system?");
			}
			return made;
		}

		/// <summary>The object as its base class. Throws if it is of another class than the named one.</summary>
		internal static T Checked<T>(GodotObject instance, string name) where T : GodotObject
		{
			if (!instance.IsClass(name))
			{
				throw new InvalidCastException($"{instance.GetClass()} is no {name}");
			}
			return (T)instance;
		}

		/// <summary>Calls a static method through an object that is made for that, as Godot 4.3 offers C# no other way.</summary>
		internal static Variant CallStatic(string name, StringName method, params Variant[] arguments)
		{
			GodotObject helper = New(name);
			try
			{
				return helper.Call(method, arguments);
			}
			finally
			{
				if (helper is RefCounted)
				{
					helper.Dispose();
				}
				else
				{
					helper.Free();
				}
			}
		}

		internal static GodotObject Singleton(string name)
		{
			if (!Engine.HasSingleton(name))
			{
				throw new InvalidOperationException($"Godot knows no singleton {name}: is addons/soft_body_2d in the project?");
			}
			return Engine.GetSingleton(name);
		}

		/// <summary>The items of an array that comes from the engine, each converted.</summary>
		internal static T[] Items<T>(Variant value, Func<Variant, T> convert)
		{
			Godot.Collections.Array array = value.AsGodotArray();
			var items = new T[array.Count];
			for (int i = 0; i < items.Length; i++)
			{
				items[i] = convert(array[i]);
			}
			return items;
		}

		internal static Variant ArrayOf(NodePath[] paths)
		{
			var array = new Godot.Collections.Array();
			foreach (NodePath path in paths)
			{
				array.Add(path);
			}
			return array;
		}

		internal static Variant ArrayOf(Vector2[][] outlines)
		{
			var array = new Godot.Collections.Array();
			foreach (Vector2[] outline in outlines)
			{
				array.Add(outline);
			}
			return array;
		}
	}
}
