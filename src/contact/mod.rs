//! Which blocks touch and where: broad phase, face pairs, patches, sub-contacts. Takes shapes and poses only.
